// Lights on ROS: their pose, and their beam on the parameter server.
#include <ambf_msgs/LightCmd.h>
#include <ambf_msgs/LightState.h>

#include <memory>

#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/parameter_server.h"
#include "ros_comm/endpoints/placed_messages.h"
#include "ros_comm/services/step_lists.h"

namespace ambf::ros_comm {

namespace {

using Messages = PlacedMessages<ambf_msgs::LightState, ambf_msgs::LightCmd, &state::Structure::lights,
                                &state::Frame::lights, &state::LightState::T_parent_light>;

constexpr const char* kCutoff = "cutoff_angle";
constexpr ParameterChoice kType{"type", {"SPOT", "POINT", "DIRECTIONAL"}};  // in the order of state::LightType

Parameters values(const state::Frame& frame, std::uint32_t slot) {
  const state::Beam& beam = frame.lights[slot].beam;
  Parameters out;
  out[kCutoff] = beam.cutoff_angle_rad;
  out[kType.name] = kType.word(static_cast<int>(beam.type));
  out[kParentName] = frame.structure->lights[slot].parent_name;
  return out;
}

std::string apply(const ParameterChange& change) {
  state::Beam beam = change.frame.lights[change.slot].beam;
  std::string problem;
  int type = static_cast<int>(beam.type);
  read_number(change.changed, kCutoff, beam.cutoff_angle_rad, problem);
  read_choice(change.changed, kType, type, problem);
  if (!problem.empty()) return problem;
  beam.type = static_cast<state::LightType>(type);
  problem = state::check(beam);
  if (problem.empty()) change.tune.set_beam(change.object.id, beam);
  return problem;
}

constexpr ParameterAccess kParameters{values, apply};

class LightEndpoint final : public ObjectEndpoint<Messages> {
 public:
  LightEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : ObjectEndpoint(parts, object, topic), parameters_(parts.parameters.offer(object, topic, kParameters)) {}

 private:
  const std::unique_ptr<ParameterServer::Offer> parameters_;
};

}  // namespace

EndpointKind light_endpoint_kind() {
  static const StepListsOf<Messages> lists(&StepRequest::light_names, &StepRequest::light_cmds, &StepResponse::lights);
  EndpointKind kind;
  kind.open = make_endpoint<LightEndpoint>;
  kind.step = &lists;
  return kind;
}

}  // namespace ambf::ros_comm
