// Live parameters: what they are now, what was loaded, which ones differ, and the panel's requests that change them.
// Main thread.
#pragma once

#include <cstdint>
#include <vector>

#include "render/panel/notices.h"
#include "state/abilities/tune.h"
#include "state/frame.h"

namespace ambf::render {

class TuneActions {
 public:
  struct Changed {
    state::ObjectId object;
    state::Parameter parameter;
    math::Vec3 loaded, now;
  };

  TuneActions(state::TuneAbility& tune, const Notices& notices) : tune_(tune), notices_(notices) {}

  // Once a picture; the frame stays valid until the next call.
  void observe(const state::Frame& frame);

  math::Vec3 now(const state::ObjectInfo& object, state::Parameter parameter) const;
  math::Vec3 loaded(const state::ObjectInfo& object, state::Parameter parameter) const;
  void set(state::ObjectId object, state::Parameter parameter, const math::Vec3& value);
  void revert(state::ObjectId object, state::Parameter parameter);
  const std::vector<Changed>& changed() const { return changed_; }
  void revert_all();
  void set_gravity(const math::Vec3& gravity_world) { tune_.set_gravity(gravity_world); }
  const math::Vec3& gravity_loaded() const { return gravity_loaded_; }

  // A value that the simulation would reject is reported instead.
  void set_lens(state::ObjectId camera, const state::Lens& lens);
  void set_beam(state::ObjectId light, const state::Beam& beam);

 private:
  const state::Structure& structure() const { return *frame_->structure; }
  void list_changed();

  state::TuneAbility& tune_;
  const Notices& notices_;
  const state::Frame* frame_ = nullptr;
  math::Vec3 gravity_loaded_;
  std::vector<Changed> changed_;
  std::uint64_t parameters_version_ = 0, structure_version_ = 0;
};

}  // namespace ambf::render
