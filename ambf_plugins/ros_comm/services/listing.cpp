#include "ros_comm/services/listing.h"

#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/endpoint_kinds.h"
#include "state/kind_rows.h"

namespace ambf::ros_comm {

namespace {

bool is_joint(const state::ObjectInfo& object) {
  const EndpointKind* kind = endpoint_kind(object.kind);
  return kind != nullptr && kind->describe_joint != nullptr;
}

ambf_msgs::JointInfo joint_info(const state::Structure& structure, const state::ObjectInfo& object,
                                const std::string& model) {
  ambf_msgs::JointInfo info;
  info.name = object.name;
  info.model = model;
  endpoint_kind(object.kind)->describe_joint(structure, object.slot, info);
  return info;
}

ambf_msgs::ObjectInfo object_info(const state::Structure& structure, const state::ObjectInfo& object,
                                  const std::string& model, const TopicNames& topics) {
  ambf_msgs::ObjectInfo info;
  info.name = object.name;
  info.kind = state::info_of(object.kind).name;
  info.model = model;
  if (const state::PlacedInfo* placed = state::rows_of(object.kind).placed(structure, object.slot)) {
    info.parent = name_of(structure, placed->parent_object);
  }
  info.topic = topics.find(object.name);
  return info;
}

}  // namespace

const state::ModelInfo* find_model(const state::Structure& structure, const std::string& name) {
  for (const state::ModelInfo& model : structure.models) {
    if (model.name == name) return &model;
  }
  return nullptr;
}

void append_names(const state::Structure& structure, state::ModelId model, std::vector<std::string>& objects,
                  std::vector<std::string>& joints) {
  for (const state::ObjectInfo& object : structure.objects) {
    if (object.model == model) (is_joint(object) ? joints : objects).push_back(object.name);
  }
}

std::set<std::string> names_in(const state::Structure& structure, const std::string& model) {
  std::set<std::string> names;
  for (const state::ModelInfo& each : structure.models) {
    if (!model.empty() && each.name != model) continue;
    for (const state::ObjectInfo& object : structure.objects) {
      if (object.model == each.id) names.insert(object.name);
    }
  }
  return names;
}

void fill_list(const state::Structure& structure, const TopicNames& topics, const std::string& model,
               ambf_msgs::List::Response& response) {
  response.structure_version = structure.version;
  for (const state::ModelInfo& each : structure.models) {
    if (!model.empty() && each.name != model) continue;
    ambf_msgs::ModelInfo info;
    info.name = each.name;
    info.path = each.file;
    append_names(structure, each.id, info.objects, info.joints);
    response.models.push_back(std::move(info));
  }
  const auto name_of_model = [&](state::ModelId id) {
    for (const state::ModelInfo& each : structure.models) {
      if (each.id == id) return each.name;
    }
    return std::string();
  };
  for (const state::ObjectInfo& object : structure.objects) {
    const std::string its_model = name_of_model(object.model);
    if (!model.empty() && its_model != model) continue;
    if (is_joint(object)) {
      response.joints.push_back(joint_info(structure, object, its_model));
    } else {
      response.objects.push_back(object_info(structure, object, its_model, topics));
    }
  }
}

}  // namespace ambf::ros_comm
