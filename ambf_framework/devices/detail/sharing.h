// What two users who share a tool do to it and feel of it, by scheme (dissertation, Fig. 3.22; EQUATIONS 7). Pure
// functions, any thread.
#pragma once

#include "state/devices.h"

namespace ambf::devices {

// 1 where a user acts or feels, else 0; by axis as in EffectorGains.
struct SharedAxes {
  math::Vec3 linear, angular;
};
struct UserShare {
  SharedAxes moves, feels;
};
// `second`: of the later one of both devices. Not for as_in_files.
UserShare share_of(state::SharingScheme scheme, bool second);

state::EffectorGains on_axes(const state::EffectorGains& gains, const SharedAxes& axes);

// `gains`, on each axis without stiffness those of `others`.
state::EffectorGains completed(const state::EffectorGains& gains, const state::EffectorGains& others);

}  // namespace ambf::devices
