// Cameras on ROS: their pose, their pictures where their file publishes some, and their lens on the parameter server.
#include <ambf_msgs/CameraCmd.h>
#include <ambf_msgs/CameraState.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/parameter_server.h"
#include "ros_comm/endpoints/placed_messages.h"
#include "ros_comm/images/image_desk.h"
#include "ros_comm/services/step_lists.h"

namespace ambf::ros_comm {

namespace {

using Messages = PlacedMessages<ambf_msgs::CameraState, ambf_msgs::CameraCmd, &state::Structure::cameras,
                                &state::Frame::cameras, &state::CameraState::T_parent_camera>;

struct LensNumber {
  const char* name;
  double state::Lens::*value;
};
constexpr LensNumber kLensNumbers[] = {
    {"near_plane", &state::Lens::near_m},
    {"far_plane", &state::Lens::far_m},
    {"field_view_angle", &state::Lens::field_of_view_rad},
    {"orthographic_view_width", &state::Lens::orthographic_width_m},
    {"stereo_eye_separation", &state::Lens::eye_separation_m},
    {"stereo_focal_length", &state::Lens::focal_length_m},
};
constexpr ParameterChoice kProjection{"projection", {"PERSPECTIVE", "ORTHOGRAPHIC"}};
constexpr ParameterChoice kMode{"mode", {"MONO", "STEREO"}};

Parameters values(const state::Frame& frame, std::uint32_t slot) {
  const state::Lens& lens = frame.cameras[slot].lens;
  Parameters out;
  for (const LensNumber& each : kLensNumbers) out[each.name] = lens.*each.value;
  out[kProjection.name] = kProjection.word(lens.orthographic ? 1 : 0);
  out[kMode.name] = kMode.word(lens.stereo ? 1 : 0);
  out[kParentName] = frame.structure->cameras[slot].parent_name;
  return out;
}

// Puts what was changed into `lens`. `width_m`: of an orthographic view that was never given one.
std::string change(state::Lens& lens, const Parameters& changed, double width_m) {
  std::string problem;
  for (const LensNumber& each : kLensNumbers) read_number(changed, each.name, lens.*each.value, problem);
  int projection = lens.orthographic ? 1 : 0, mode = lens.stereo ? 1 : 0;
  read_choice(changed, kProjection, projection, problem);
  read_choice(changed, kMode, mode, problem);
  if (!problem.empty()) return problem;
  lens.orthographic = projection == 1;
  lens.stereo = mode == 1;
  if (lens.orthographic && lens.orthographic_width_m == 0.0) lens.orthographic_width_m = width_m;
  return state::check(lens);
}

std::string apply(const ParameterChange& change_in) {
  const state::CameraState& now = change_in.frame.cameras[change_in.slot];
  const state::CameraInfo& info = change_in.frame.structure->cameras[change_in.slot];
  // An orthographic view without a width shows what the perspective one shows at the point the camera looks at.
  const double distance_m = math::norm(now.T_parent_camera.position - info.look_at);
  state::Lens lens = now.lens;
  std::string problem =
      change(lens, change_in.changed, std::max(1e-3, 2.0 * distance_m * std::tan(lens.field_of_view_rad / 2.0)));
  if (!problem.empty()) return problem;
  change_in.tune.set_lens(change_in.object.id, lens);
  if (lens.stereo && !now.lens.stereo && info.image.on && !info.lens.stereo) {
    change_in.log.warning(
        "ROS: '%s' shows both eyes in its window now, but publishes no left/ and right/ pictures: their topics are "
        "made for cameras that are loaded with `stereo`",
        change_in.object.name.c_str());
  }
  return {};
}

constexpr ParameterAccess kParameters{values, apply};

class CameraEndpoint final : public ObjectEndpoint<Messages> {
 public:
  CameraEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : ObjectEndpoint(parts, object, topic), parameters_(parts.parameters.offer(object, topic, kParameters)) {
    const std::shared_ptr<const state::Structure> structure = parts.simulation.observe.structure();
    const std::uint32_t found = state::find(*structure, object.id);
    if (found == state::kNone) return;  // it was removed meanwhile
    const state::CameraInfo& camera = structure->cameras[structure->objects[found].slot];
    if (camera.image.on || camera.depth.on) {
      pictures_ = std::make_unique<ImageDesk::Place>(parts.images, object, topic, camera);
    }
  }

 private:
  const std::unique_ptr<ParameterServer::Offer> parameters_;
  std::unique_ptr<ImageDesk::Place> pictures_;
};

}  // namespace

EndpointKind camera_endpoint_kind() {
  static const StepListsOf<Messages> lists(&StepRequest::camera_names, &StepRequest::camera_cmds,
                                           &StepResponse::cameras);
  EndpointKind kind;
  kind.open = make_endpoint<CameraEndpoint>;
  kind.step = &lists;
  return kind;
}

}  // namespace ambf::ros_comm
