// How the catalogue takes in what a file describes.
#include "model/detail/catalogue_impl.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "scene/lookup.h"

namespace ambf::model {
namespace {

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
  model.info.environment = load_options.environment;
  model.description = description;

  loaded_bodies.clear();
  wanted_numbers = load_options.conflict_numbers;
  for (const auto& kind : kinds()) kind->load(*this, model, load_options, findings);
  find_missing_parents();
  report_parents(description, model.info.id, findings);
  return model.info;
}

std::string Catalogue::Impl::full_namespace(const scene::Identity& identity, const LoadOptions& load) const {
  return scene::join_namespace({}, options.namespace_prefix + load.name_prefix + identity.name_space);
}

Entry* Catalogue::Impl::add_entry(state::ObjectKind kind, const scene::Identity& identity, state::ModelId model,
                                  const std::string& name_space, Findings& findings) {
  std::uint32_t index = 0;
  if (!free_indices.empty()) {
    index = free_indices.back();
    free_indices.pop_back();
  } else if (generations.size() < base::kMaxObjects) {
    index = static_cast<std::uint32_t>(generations.size());
    generations.push_back(0);
  } else {
    findings.error(identity, {},
                   "there are " + std::to_string(base::kMaxObjects) + " objects already; no more are taken");
    return nullptr;
  }

  auto entry = std::make_unique<Entry>();
  entry->identifier = identity.identifier;
  entry->name_space = name_space;
  entry->own_identifier = name_space + identity.identifier;
  const auto wanted = wanted_numbers.find(identity.identifier);
  entry->conflict_number = names.reserve(kind, entry->own_identifier, name_space + identity.name,
                                         wanted == wanted_numbers.end() ? std::string() : wanted->second);
  entry->info.id = {index, generations[index]};
  entry->info.kind = kind;
  entry->info.model = model;
  entry->info.name = name_space + identity.name + entry->conflict_number;
  entry->info.local_name = identity.name + entry->conflict_number;
  entry->info.identifier = entry->own_identifier + entry->conflict_number;
  entry->info.passive = identity.passive;
  entry->info.rate_low_hz = options.rate_low_hz.value_or(identity.rate_low_hz);
  entry->info.rate_high_hz = options.rate_high_hz.value_or(identity.rate_high_hz);
  if (!entry->conflict_number.empty() && state::info_of(kind).has_topics)
    findings.information(identity, "name",
                         name_space + identity.name + " is there already; this one is called " + entry->info.name);
  entries.push_back(std::move(entry));
  return entries.back().get();
}

// ADF 1.5: the file's own bodies first, then the world's.
Entry* Catalogue::Impl::find_body(const std::string& wanted, const Entry& joint, const char* key,
                                  const scene::Identity& at, Findings& findings) const {
  // Nearly all files write whole names; the lists below cost as much as there are bodies.
  for (const std::string& name : {wanted, joint.name_space + wanted})
    if (const auto at_once = loaded_bodies.find(name); at_once != loaded_bodies.end()) return at_once->second;
  std::vector<std::string> own, world;
  std::vector<Entry*> own_bodies, world_bodies;
  for (const auto& entry : entries) {
    if (!state::info_of(entry->info.kind).has_mass) continue;
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
      if (state::info_of(entry->info.kind).has_mass) known.push_back(entry->identifier);
    return known;
  }());
  findings.error(at, key, "there is no body \"" + wanted + "\"",
                 near.empty() ? "the joint is left out" : "did you mean \"" + near + "\"? The joint is left out");
  return nullptr;
}

Entry* Catalogue::Impl::find_joint(const std::string& wanted, const Entry& follower) const {
  std::vector<std::string> own, world;
  std::vector<Entry*> own_joints, world_joints;
  for (const auto& entry : entries) {
    if (!state::info_of(entry->info.kind).connects_bodies || entry.get() == &follower) continue;
    // Nearly all files write whole names; the lists cost as much as there are joints.
    const bool is_own = entry->info.model == follower.info.model;
    if (is_own && (entry->own_identifier == wanted || entry->own_identifier == follower.name_space + wanted))
      return entry.get();
    world_joints.push_back(entry.get());
    if (is_own) own_joints.push_back(entry.get());
  }
  for (const Entry* joint : own_joints) own.push_back(joint->own_identifier);
  for (const Entry* joint : world_joints) world.push_back(joint->info.identifier);
  const scene::Lookup found = scene::find_joint_body(own, world, wanted, follower.name_space, follower.conflict_number);
  if (!found.index) return nullptr;
  return found.in_world ? world_joints[*found.index] : own_joints[*found.index];
}

std::map<state::ModelId, std::map<std::string, std::string>> Catalogue::numbers_to_keep(
    const std::set<state::ModelId>& without) const {
  std::map<state::ModelId, std::map<std::string, std::string>> kept;
  Names names;  // as they fill when all is loaded again
  const std::string& world = impl_->newest->world_name;
  names.reserve(state::ObjectKind{}, world, world);
  for (const auto& entry : impl_->entries) {
    if (without.contains(entry->info.model)) continue;
    const std::string& has = entry->conflict_number;
    const std::string name = entry->info.name.substr(0, entry->info.name.size() - has.size());
    const std::string gets = names.reserve(entry->info.kind, entry->own_identifier, name);
    if (gets == has) continue;
    names.release(entry->info.kind, entry->own_identifier + gets, name + gets);
    names.reserve(entry->info.kind, entry->own_identifier, name, has);
    kept[entry->info.model][entry->identifier] = has;
  }
  return kept;
}

}  // namespace ambf::model
