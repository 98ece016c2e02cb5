// How the catalogue takes in what a file describes.
#include "math/rotation.h"
#include "model/detail/catalogue_impl.h"
#include "model/detail/view_builder.h"
#include "scene/lookup.h"

namespace ambf::model {
namespace {

using state::JointType;
using state::ObjectKind;

bool has_coordinate(JointType type) {
  return type == JointType::revolute || type == JointType::prismatic || type == JointType::linear_spring ||
         type == JointType::torsion_spring;
}

std::string list_of(const std::vector<std::string>& names, const std::vector<std::size_t>& which) {
  std::string list;
  for (const std::size_t i : which) list += (list.empty() ? "" : ", ") + names[i];
  return list;
}

}  // namespace

const state::ModelInfo& Catalogue::Impl::load(const scene::Model& description, const LoadOptions& load_options,
                                              Findings& findings) {
  std::vector<std::string> taken;
  for (const auto& model : models) taken.push_back(model->info.name);
  models.push_back(std::make_unique<LoadedModel>());
  LoadedModel& model = *models.back();
  model.info.id = next_model++;
  model.info.name = description.name + scene::conflict_number(taken, description.name);
  model.info.file = description.file;
  model.description = description;

  bodies.prefetch(description.bodies);
  for (const scene::Body& body : description.bodies) add_body(body, model, load_options, findings);
  for (const scene::Joint& joint : description.joints) add_joint(joint, model, load_options, findings);
  for (const scene::Camera& camera : description.cameras) add_camera(camera, model.info.id, load_options, findings);
  for (const scene::Light& light : description.lights) add_light(light, model.info.id, load_options, findings);
  find_missing_parents();
  report_parents(description, model.info.id, findings);
  return model.info;
}

std::string Catalogue::Impl::full_namespace(const scene::Identity& identity, const LoadOptions& load) const {
  return scene::join_namespace({}, options.namespace_prefix + load.name_prefix + identity.name_space);
}

Entry* Catalogue::Impl::add_entry(ObjectKind kind, const scene::Identity& identity, state::ModelId model,
                                  const std::string& name_space, Findings& findings) {
  std::uint32_t index = 0;
  if (!free_indices.empty()) {
    index = free_indices.back();
    free_indices.pop_back();
  } else if (generations.size() < kMaxObjects) {
    index = static_cast<std::uint32_t>(generations.size());
    generations.push_back(0);
  } else {
    findings.error(identity, {}, "there are " + std::to_string(kMaxObjects) + " objects already; no more are taken");
    return nullptr;
  }

  auto entry = std::make_unique<Entry>();
  entry->identifier = identity.identifier;
  entry->name_space = name_space;
  entry->own_identifier = name_space + identity.identifier;
  entry->conflict_number = names.reserve(kind, entry->own_identifier, name_space + identity.name);
  entry->info.id = {index, generations[index]};
  entry->info.kind = kind;
  entry->info.model = model;
  entry->info.name = name_space + identity.name + entry->conflict_number;
  entry->info.local_name = identity.name + entry->conflict_number;
  entry->info.identifier = entry->own_identifier + entry->conflict_number;
  entry->info.passive = identity.passive;
  entry->info.rate_low_hz = options.rate_low_hz.value_or(identity.rate_low_hz);
  entry->info.rate_high_hz = options.rate_high_hz.value_or(identity.rate_high_hz);
  if (!entry->conflict_number.empty() && kind != ObjectKind::joint)
    findings.information(identity, "name",
                         name_space + identity.name + " is there already; this one is called " + entry->info.name);
  entries.push_back(std::move(entry));
  return entries.back().get();
}

void Catalogue::Impl::add_body(const scene::Body& body, const LoadedModel& model, const LoadOptions& load,
                               Findings& findings) {
  Entry* entry =
      add_entry(ObjectKind::rigid_body, body.identity, model.info.id, full_namespace(body.identity, load), findings);
  if (entry == nullptr) return;
  BodySurroundings surroundings;
  surroundings.T_world_model = load.T_world_model;
  surroundings.gravity = model.description.gravity;
  surroundings.no_collision_set = model.description.ignore_inter_collision ? model.info.id : 0;
  surroundings.step_s = options.step_s;
  surroundings.shaders = shader_files(model.description.shaders);
  BuiltBody built = bodies.build(body, surroundings, findings);

  entry->physics_body = built.live->body.get();
  entry->scale = body.scale;
  entry->body.mass = built.live->body->mass();
  entry->body.inertia = built.live->body->inertia();
  entry->body.T_body_com = built.live->body->T_body_com();
  entry->body.parameters = parameters_of(*built.live);
  entry->body.linear_output = body.linear.output;
  entry->body.angular_output = body.angular.output;
  entry->body.publish_children_names = body.publish_children_names;
  entry->body.publish_joint_names = body.publish_joint_names;
  entry->body.publish_joint_positions = body.publish_joint_positions;
  entry->body.appearance = std::move(built.appearance);
  entry->body.collision_appearance = std::move(built.collision_appearance);
  entry->live_body = std::move(built.live);
  entry->live_body->slots = commands.add(entry->info.id, ObjectKind::rigid_body);
}

// ADF 1.5: the file's own bodies first, then the world's.
Entry* Catalogue::Impl::find_body(const std::string& wanted, const Entry& joint, const char* key,
                                  const scene::Identity& at, Findings& findings) const {
  std::vector<std::string> own, world;
  std::vector<Entry*> own_bodies, world_bodies;
  for (const auto& entry : entries) {
    if (entry->info.kind != ObjectKind::rigid_body) continue;
    world.push_back(entry->info.identifier);
    world_bodies.push_back(entry.get());
    if (entry->info.model != joint.info.model) continue;
    own.push_back(entry->own_identifier);
    own_bodies.push_back(entry.get());
  }
  const scene::Lookup found = scene::find_joint_body(own, world, wanted, joint.name_space, joint.conflict_number);
  if (found.index) return found.in_world ? world_bodies[*found.index] : own_bodies[*found.index];

  if (!found.candidates.empty()) {
    findings.error(at, key,
                   "\"" + wanted + "\" is ambiguous: " + list_of(found.in_world ? world : own, found.candidates),
                   "give the full identifier; the joint is left out");
    return nullptr;
  }
  const std::string near = scene::nearest(wanted, [&] {
    std::vector<std::string> known;
    for (const auto& entry : entries)
      if (entry->info.kind == ObjectKind::rigid_body) known.push_back(entry->identifier);
    return known;
  }());
  findings.error(at, key, "there is no body \"" + wanted + "\"",
                 near.empty() ? "the joint is left out" : "did you mean \"" + near + "\"? The joint is left out");
  return nullptr;
}

void Catalogue::Impl::add_joint(const scene::Joint& joint, const LoadedModel& model, const LoadOptions& load,
                                Findings& findings) {
  Entry* entry =
      add_entry(ObjectKind::joint, joint.identity, model.info.id, full_namespace(joint.identity, load), findings);
  if (entry == nullptr) return;
  const auto leave_out = [&] {
    names.release(ObjectKind::joint, entry->info.identifier, entry->info.name);
    free_indices.push_back(entry->info.id.index);
    entries.pop_back();
  };
  Entry* parent = find_body(joint.parent, *entry, "parent", joint.identity, findings);
  Entry* child = find_body(joint.child, *entry, "child", joint.identity, findings);
  if (parent == nullptr || child == nullptr) return leave_out();
  if (parent == child) {
    findings.error(joint.identity, "child", "parent and child are the same body: " + parent->info.identifier,
                   "a joint needs two bodies; it is left out");
    return leave_out();
  }
  if (parent->body.mass == 0.0 && child->body.mass == 0.0)
    findings.warning(joint.identity, "parent", "both bodies are static: the joint moves nothing",
                     "give one of them a mass");
  scene::Joint described = joint;
  for (math::Vec3* axis : {&described.parent_axis, &described.child_axis}) {
    if (joint.type == JointType::p2p || math::norm(*axis) > 1e-9) {
      *axis = math::normalized(*axis);
      continue;
    }
    findings.error(joint.identity, axis == &described.parent_axis ? "parent axis" : "child axis", "has no length",
                   "give a direction; the joint is left out");
    return leave_out();
  }

  physics::JointOptions physics_options;
  physics_options.parent_scale = parent->scale;
  physics_options.child_scale = child->scale;
  physics_options.erp = model.description.joint_erp.value_or(physics_options.erp);
  physics_options.cfm = model.description.joint_cfm.value_or(physics_options.cfm);
  auto physics_joint =
      std::make_unique<physics::Joint>(described, *parent->physics_body, *child->physics_body, physics_options);

  entry->parent = parent;
  entry->child = child;
  entry->joint.type = joint.type;
  entry->joint.name = joint.identity.name;
  entry->joint.passive = joint.identity.passive;
  entry->joint.has_limits = joint.limits.has_value();
  if (joint.limits) {
    entry->joint.lower = (*joint.limits)[0];
    entry->joint.upper = (*joint.limits)[1];
  }
  entry->joint.pivot_parent = joint.parent_pivot * parent->scale;
  entry->joint.axis_parent = described.parent_axis;

  if (joint.type == JointType::cone_twist || joint.type == JointType::six_dof ||
      joint.type == JointType::six_dof_spring) {
    const scene::SixDofLimits& range = joint.six_dof;
    entry->joint.span = std::make_shared<const state::JointSpan>(
        state::JointSpan{physics_joint->frame_in_parent(), physics_joint->frame_in_child(), joint.cone_limits,
                         range.linear_low, range.linear_high, range.angular_low, range.angular_high});
  }

  const bool continuous = joint.type == JointType::revolute && !joint.limits;
  entry->live_joint =
      std::make_unique<LiveJoint>(std::move(physics_joint), JointController(joint.controller, continuous));
  LiveJoint& live = *entry->live_joint;
  live.feedback = joint.enable_feedback;
  entry->joint.parameters = parameters_of(live);
  entry->joint.output = joint.controller.output;
  // A joint that is controlled through its motor is held by it from the start; one that is controlled by effort, or is passive, or
  // is a spring, moves freely until it is commanded.
  live.motor_holds = joint.enable_motor && !joint.identity.passive && has_coordinate(joint.type) &&
                     (joint.type == JointType::revolute || joint.type == JointType::prismatic) &&
                     joint.controller.output != scene::ControllerOutput::force;
  if (live.motor_holds) live.joint->set_motor_velocity(0.0);
  if (joint.controller.output == scene::ControllerOutput::position)
    findings.information(joint.identity, "controller output type", "joints have no position output; velocity does it");
  lineage.add(entry->info.id.index, parent->info.id.index, child->info.id.index);
}

void Catalogue::Impl::add_placed(Entry& entry, const std::string& parent, math::Pose T_parent,
                                 const LoadOptions& load) {
  entry.wanted_parent = entry.loaded_parent = parent;
  entry.live_placed = std::make_unique<LivePlaced>();
  if (parent.empty()) T_parent = load.T_world_model * T_parent;
  LivePlaced& live = *entry.live_placed;
  live.T_parent = live.T_parent_initial = live.T_parent_loaded = T_parent;
  entry.live_placed->slots = commands.add(entry.info.id, entry.info.kind);
}

void Catalogue::Impl::add_camera(const scene::Camera& camera, state::ModelId model, const LoadOptions& load,
                                 Findings& findings) {
  Entry* entry = add_entry(ObjectKind::camera, camera.identity, model, full_namespace(camera.identity, load), findings);
  if (entry == nullptr) return;
  entry->camera = camera_info(camera);
  if (camera.parent.empty()) entry->camera.look_at = load.T_world_model * camera.look_at;
  add_placed(*entry, camera.parent, camera_pose(camera), load);
  entry->live_placed->lens = entry->camera.lens;
}

void Catalogue::Impl::add_light(const scene::Light& light, state::ModelId model, const LoadOptions& load,
                                Findings& findings) {
  Entry* entry = add_entry(ObjectKind::light, light.identity, model, full_namespace(light.identity, load), findings);
  if (entry == nullptr) return;
  entry->light = light_info(light);
  add_placed(*entry, light.parent, light_pose(light), load);
  entry->live_placed->beam = entry->light.beam;
}

}  // namespace ambf::model
