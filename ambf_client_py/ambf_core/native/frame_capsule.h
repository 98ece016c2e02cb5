// How _ambf_core hands a frame to _ambf_view: in a capsule, valid only during the call that it is an argument of.
#pragma once

#include <nanobind/nanobind.h>

#include "state/frame.h"

namespace ambf::python {

inline constexpr const char* kFrameCapsule = "ambf::state::Frame";

inline nanobind::capsule capsule_of(const state::Frame& frame) { return nanobind::capsule(&frame, kFrameCapsule); }

inline const state::Frame& frame_in(const nanobind::capsule& capsule) {
  const void* pointer = PyCapsule_GetPointer(capsule.ptr(), kFrameCapsule);
  if (pointer == nullptr) throw nanobind::python_error();
  return *static_cast<const state::Frame*>(pointer);
}

}  // namespace ambf::python
