#include "crtk/endoscope_camera.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"

namespace ambf::crtk {

namespace {

constexpr double kThere = 1e-9;  // m, rad

// Axes of the ECM's tip, up, right, away, in the camera's: back, right, up (docs/frames.md).
const math::Pose kT_camera_tip{{}, math::from_axis_angle({0.0, 1.0, 0.0}, -M_PI / 2)};

bool is_there(const math::Pose& a, const math::Pose& b) {
  return math::norm(a.position - b.position) < kThere &&
         math::norm(math::log(math::inverse(a.orientation) * b.orientation)) < kThere;
}

}  // namespace

void EndoscopeCamera::find(const state::Structure& structure, const std::string& name, std::uint32_t base) {
  slot_ = state::kNone;
  const state::BodyInfo& body = structure.bodies[structure.objects[base].slot];
  for (std::uint32_t slot = 0; slot < structure.cameras.size(); ++slot) {
    const state::CameraInfo& camera = structure.cameras[slot];
    const state::ObjectInfo& object = structure.objects[camera.object];
    const bool named = object.name == name || object.identifier == name;
    const bool on_arm =
        std::find(body.children.begin(), body.children.end(), camera.parent_object) != body.children.end();
    if (named && on_arm) slot_ = slot;
  }
}

void EndoscopeCamera::follow(const state::Frame& frame, state::CommandAbility& command, const std::string& name,
                             std::uint32_t base, const kinematics::Arm& straight, const kinematics::Arm& now) {
  const state::Structure& structure = *frame.structure;
  if (structure.version != structure_version_) {
    structure_version_ = structure.version;
    find(structure, name, base);
  }
  if (slot_ == state::kNone) return;
  const state::ObjectId id = structure.objects[structure.cameras[slot_].object].id;
  const math::Pose& T_parent = frame.cameras[slot_].T_parent_camera;
  if (!(id == camera_)) {
    camera_ = id;
    port_ = command.bind(id, state::Source::plugin);
    T_parent_straight_ = T_parent;
    tool_ = straight.tool;
    epoch_ = frame.epoch;
  }
  if (port_ == nullptr) return;
  // A reset puts it back, a restored state where it was then.
  if (tool_ != now.tool || epoch_ != frame.epoch) {
    tool_ = now.tool;
    epoch_ = frame.epoch;
    const math::Pose T_straight_tip = math::inverse(straight.tip) * now.tip;
    wanted_ = T_parent_straight_ * kT_camera_tip * T_straight_tip * math::inverse(kT_camera_tip);
    pending_ = !is_there(T_parent, wanted_);
    if (!pending_) return;
    port_->hold();
    port_->post(state::PoseCommand{true, wanted_});
  } else if (pending_ && is_there(T_parent, wanted_)) {
    pending_ = false;
    port_->release();
  }
}

}  // namespace ambf::crtk
