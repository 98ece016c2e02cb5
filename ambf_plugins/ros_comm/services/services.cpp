#include "ros_comm/services/services.h"

#include <chrono>
#include <future>

#include "base/bounds.h"
#include "base/clock.h"
#include "math/rotation.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/endpoint_kinds.h"
#include "ros_comm/services/listing.h"
#include "ros_comm/services/step_answer.h"
#include "ros_comm/services/tuning.h"
#include "state/command.h"
#include "state/kinds.h"

namespace ambf::ros_comm {

namespace {

constexpr std::chrono::milliseconds kEndCheckInterval{20};  // while waiting for an outcome
constexpr std::chrono::milliseconds kRecordTimeout{1000};   // for the publisher thread, which may be in a long frame
constexpr std::uint32_t kStepCommandsQueue = 1000;          // requests: a third of a second of a client that steps fast
constexpr const char* kEnding = "the simulator is ending";

template <class Response>
void answer(const state::Outcome& outcome, Response& response) {
  response.success = outcome.success;
  response.message = outcome.message;
  for (const base::Diagnostic& diagnostic : outcome.diagnostics) response.diagnostics.push_back(to_ros(diagnostic));
}

// Empty, or why a request with this name or path is refused: so that no answer and no line of the log repeats 10 MB.
std::string too_long(const char* field, const std::string& text) {
  if (text.size() <= base::kMaxPath) return {};
  return std::string(field) + " has " + std::to_string(text.size()) + " bytes; expected at most " +
         std::to_string(base::kMaxPath);
}

// Answers with the refusal; true: there was one.
template <class Response>
bool refused(const std::string& why, Response& response) {
  if (why.empty()) return false;
  response.success = 0;
  response.message = why;
  return true;
}

// As what is dropped on a window. What was found in a refused file is logged before, as errors.
void log_load(const state::Outcome& outcome, const std::string& path, base::Log& log) {
  outcome.success ? log.info("%s", outcome.message.c_str()) : log.info("'%s' was refused", path.c_str());
}

math::Pose pose_or_identity(const geometry_msgs::Pose& pose) {
  math::Pose out = from_ros(pose);
  if (math::norm(out.orientation) == 0.0) out.orientation = {};
  return out;
}

}  // namespace

template <class Start>
state::Outcome Services::wait_for(Start start) const {
  auto promise = std::make_shared<std::promise<state::Outcome>>();
  auto future = promise->get_future();
  start([promise](const state::Outcome& outcome) { promise->set_value(outcome); });
  while (future.wait_for(kEndCheckInterval) != std::future_status::ready) {
    if (!ending()) continue;
    state::Outcome outcome;
    outcome.message = kEnding;
    return outcome;
  }
  return future.get();
}

template <class Service>
void Services::offer(const std::string& name,
                     bool (Services::*handler)(typename Service::Request&, typename Service::Response&)) {
  offered_.push_back(std::make_unique<OfferedService<Service>>(
      node_, world_topic_ + "/" + name, gate_,
      [this, handler](typename Service::Request& request, typename Service::Response& response) {
        return (this->*handler)(request, response);
      }));
}

Services::Services(Node& node, const std::string& world_topic, const TopicNames& topics,
                   const state::Abilities& simulation)
    : node_(node),
      world_topic_(world_topic),
      topics_(topics),
      simulation_(simulation),
      step_commands_(node, world_topic + "/StepCommands", kStepCommandsQueue) {
  offer<ambf_msgs::Load>("Load", &Services::load);
  offer<ambf_msgs::Unload>("Unload", &Services::unload);
  offer<ambf_msgs::Remove>("Remove", &Services::remove);
  offer<ambf_msgs::Save>("Save", &Services::save);
  offer<ambf_msgs::List>("List", &Services::list);
  offer<ambf_msgs::Step>("Step", &Services::step);
  offer<ambf_msgs::Snapshot>("Snapshot", &Services::snapshot);
  offer<ambf_msgs::Restore>("Restore", &Services::restore);
  offer<ambf_msgs::Forget>("Forget", &Services::forget);
  offer<ambf_msgs::Record>("Record", &Services::record);
  offer<ambf_msgs::Hold>("Hold", &Services::hold);
  offer<ambf_msgs::Tune>("Tune", &Services::tune);
  offer<ambf_msgs::Received>("Received", &Services::received);
}

Services::~Services() {
  closing_ = true;
  gate_->close();
}

bool Services::load(ambf_msgs::Load::Request& request, ambf_msgs::Load::Response& response) {
  state::LoadRequest wanted;
  wanted.path = request.path;
  wanted.text = request.text;
  wanted.name_prefix = request.name_prefix;
  wanted.check_only = request.check_only != 0;
  state::PoseCommand placed;  // is judged as where other objects are put
  placed.enabled = true;
  placed.T_parent_object = pose_or_identity(request.pose);
  if (const std::string why = state::check(placed); !why.empty()) return refused("pose: " + why, response);
  if (refused(too_long("path", request.path), response)) return true;
  if (refused(too_long("name_prefix", request.name_prefix), response)) return true;
  wanted.T_world_model = placed.T_parent_object;
  const bool check_only = wanted.check_only;
  const state::Outcome outcome =
      wait_for([&](state::Completion done) { simulation_.edit.load(std::move(wanted), std::move(done)); });
  answer(outcome, response);
  if (!check_only) log_load(outcome, request.path, node_.log());
  response.model = outcome.model;
  if (!outcome.success) return true;
  const auto structure = simulation_.observe.structure();
  if (const state::ModelInfo* model = find_model(*structure, outcome.model)) {
    append_names(*structure, model->id, response.objects, response.joints);
  }
  return true;
}

bool Services::unload(ambf_msgs::Unload::Request& request, ambf_msgs::Unload::Response& response) {
  if (refused(too_long("model", request.model), response)) return true;
  const auto before = names_in(*simulation_.observe.structure(), request.model);
  const state::Outcome outcome =
      wait_for([&](state::Completion done) { simulation_.edit.unload(request.model, std::move(done)); });
  answer(outcome, response);
  if (outcome.success) response.removed.assign(before.begin(), before.end());
  return true;
}

bool Services::remove(ambf_msgs::Remove::Request& request, ambf_msgs::Remove::Response& response) {
  if (refused(too_long("name", request.name), response)) return true;
  const auto before = names_in(*simulation_.observe.structure());
  const state::Outcome outcome =
      wait_for([&](state::Completion done) { simulation_.edit.remove(request.name, std::move(done)); });
  answer(outcome, response);
  if (!outcome.success) return true;
  const auto after = names_in(*simulation_.observe.structure());
  for (const std::string& name : before) {
    if (after.count(name) == 0) response.removed.push_back(name);
  }
  return true;
}

bool Services::save(ambf_msgs::Save::Request& request, ambf_msgs::Save::Response& response) {
  if (refused(too_long("model", request.model), response)) return true;
  if (refused(too_long("path", request.path), response)) return true;
  state::SaveModelRequest wanted{request.model, request.path, request.current_pose != 0, request.overwrite != 0};
  const state::Outcome outcome =
      wait_for([&](state::Completion done) { simulation_.edit.save(std::move(wanted), std::move(done)); });
  answer(outcome, response);
  response.size = outcome.bytes;
  if (!outcome.success) return true;
  response.path = outcome.model;
  node_.log().info("%s", outcome.message.c_str());
  return true;
}

bool Services::list(ambf_msgs::List::Request& request, ambf_msgs::List::Response& response) {
  fill_list(*simulation_.observe.structure(), topics_, request.model, response);
  response.success = 1;
  response.snapshots = simulation_.run.snapshots();
  return true;
}

bool Services::step(ambf_msgs::Step::Request& request, ambf_msgs::Step::Response& response) {
  const ros::Time received = ros::Time::now();
  state::ObjectId refused;  // the object whose command is refused; invalid: none
  const auto refuse = [&](std::string why) {
    simulation_.command.count_refused_command(refused);
    node_.traffic().refuse(world_topic_ + "/Step", why);
    response.success = 0;
    response.message = std::move(why);
    return true;
  };

  const auto structure = simulation_.observe.structure();
  std::vector<state::AddressedCommand> commands;
  std::string problem;
  for (const auto& [kind, entry] : endpoint_kinds()) {
    if (entry.step == nullptr) continue;
    const auto add = [&, kind = kind](const std::string& name, const std::string& refusal, state::Command command) {
      if (problem = too_long("a name", name); !problem.empty()) return;
      const std::uint32_t index = state::find(*structure, name, kind);
      if (index == state::kNone) {
        problem = "there is no " + state::info_of(kind).name + " '" + name + "' (or several fit)";
      } else if (!refusal.empty()) {
        problem = "command to '" + name + "': " + refusal;
        refused = structure->objects[index].id;
      } else {
        commands.push_back({structure->objects[index].id, std::move(command)});
      }
    };
    if (!entry.step->read(request, *structure, add))
      return refuse("each list of names must be as long as its list of commands");
  }
  if (!problem.empty()) return refuse(problem);
  if (std::string why = StepAnswer::refusal(request.wanted_states, *structure); !why.empty()) return refuse(why);

  const std::unique_ptr<state::StepTicket> ticket = simulation_.run.step(request.n, std::move(commands), true);
  StepAnswer states(request.wanted_states, response);
  states.prepare(structure);
  while (!ticket->wait(kEndCheckInterval)) {
    if (!ending()) continue;
    states.clear();
    response.success = 0;
    response.message = kEnding;
    return true;
  }
  const state::Outcome& outcome = ticket->outcome();
  answer(outcome, response);
  response.sim_step = outcome.sim_step;
  response.sim_time = outcome.sim_time;
  if (const state::Frame* frame = ticket->frame()) {
    publish_commands(received, ticket->first_step(), frame->sim_step, request);
    states.fill(*frame);
    if (std::string why = states.too_large(); !why.empty()) {
      states.clear();
      response.message = why;
    }
  } else {
    states.clear();
  }
  return true;
}

void Services::publish_commands(ros::Time received, std::uint32_t first_step, std::uint32_t last_step,
                                ambf_msgs::Step::Request& request) {
  if (step_commands_.subscribers() == 0) return;
  ambf_msgs::StepCommands message;
  message.header.stamp = received;
  message.sim_step = first_step;
  message.n = last_step + 1 - first_step;
  message.rigid_body_names.swap(request.rigid_body_names);
  message.rigid_body_cmds.swap(request.rigid_body_cmds);
  message.camera_names.swap(request.camera_names);
  message.camera_cmds.swap(request.camera_cmds);
  message.light_names.swap(request.light_names);
  message.light_cmds.swap(request.light_cmds);
  message.actuator_names.swap(request.actuator_names);
  message.actuator_cmds.swap(request.actuator_cmds);
  message.vehicle_names.swap(request.vehicle_names);
  message.vehicle_cmds.swap(request.vehicle_cmds);
  const bool commands = !message.rigid_body_names.empty() || !message.camera_names.empty() ||
                        !message.light_names.empty() || !message.actuator_names.empty() ||
                        !message.vehicle_names.empty();
  if (message.n > 0 || commands) step_commands_.publish(message);
}

bool Services::record(ambf_msgs::Record::Request& request, ambf_msgs::Record::Response& response) {
  StepRequests& requests = node_.step_requests();
  response.message =
      requests.request(request.recorder, request.topics, request.every, base::steady_ns(), response.topics);
  if (response.message.empty() && !requests.wait_until_in_force(kRecordTimeout)) {
    response.message = "the publisher is busy; the request is in force soon";
  }
  response.success = response.message.empty();
  response.lease = base::to_seconds(StepRequests::kLease_ns);
  return true;
}

bool Services::received(ambf_msgs::Received::Request& request, ambf_msgs::Received::Response& response) {
  response.success = node_.step_requests().receipt(request.recorder, static_cast<std::int64_t>(request.stamp.toNSec()));
  return true;
}

bool Services::hold(ambf_msgs::Hold::Request& request, ambf_msgs::Hold::Response& response) {
  const auto structure = simulation_.observe.structure();
  std::vector<state::ObjectId> objects;
  for (const std::string& name : request.names) {
    std::uint32_t index = state::kNone;
    state::for_each_kind([&](state::ObjectKind kind, const state::KindInfo& info) {
      if (index == state::kNone && (info.has_mass || info.connects_bodies)) index = state::find(*structure, name, kind);
    });
    if (index == state::kNone) {
      response.message = "there is no body or joint '" + name + "' (or several fit)";
      return true;
    }
    objects.push_back(structure->objects[index].id);
  }
  for (const state::ObjectId object : objects) {
    const state::Outcome outcome = wait_for(
        [&](state::Completion done) { simulation_.tune.set_hold(object, request.hold != 0, std::move(done)); });
    response.message = outcome.message;
    if (!outcome.success) return true;
  }
  response.success = 1;
  return true;
}

bool Services::tune(ambf_msgs::Tune::Request& request, ambf_msgs::Tune::Response& response) {
  Tuning tuning;
  if (refused(read_tuning(request, *simulation_.observe.structure(), tuning), response)) return true;
  if (tuning.gravity_world) simulation_.tune.set_gravity(*tuning.gravity_world);
  for (const Tuning::Change& change : tuning.changes) {
    const state::Outcome outcome = wait_for([&](state::Completion done) {
      simulation_.tune.set_parameter(change.object, change.parameter, change.value, std::move(done));
    });
    response.message = outcome.message;
    if (!outcome.success) return true;  // it was removed meanwhile
  }
  response.success = 1;
  return true;
}

bool Services::snapshot(ambf_msgs::Snapshot::Request& request, ambf_msgs::Snapshot::Response& response) {
  const state::Outcome outcome =
      wait_for([&](state::Completion done) { simulation_.run.snapshot(request.name, request.path, std::move(done)); });
  answer(outcome, response);
  response.name = outcome.model;
  response.sim_step = outcome.sim_step;
  response.sim_time = outcome.sim_time;
  response.size = outcome.bytes;
  return true;
}

bool Services::restore(ambf_msgs::Restore::Request& request, ambf_msgs::Restore::Response& response) {
  const state::Outcome outcome =
      wait_for([&](state::Completion done) { simulation_.run.restore(request.name, request.path, std::move(done)); });
  answer(outcome, response);
  response.sim_step = outcome.sim_step;
  response.sim_time = outcome.sim_time;
  return true;
}

bool Services::forget(ambf_msgs::Forget::Request& request, ambf_msgs::Forget::Response& response) {
  answer(wait_for([&](state::Completion done) { simulation_.run.forget(request.name, std::move(done)); }), response);
  return true;
}

}  // namespace ambf::ros_comm
