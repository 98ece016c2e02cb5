// What loading would say, without loading.
#include <unordered_map>

#include "model/detail/catalogue_impl.h"

namespace ambf::model {

void Catalogue::Impl::stand_in_for(const Impl& other, std::vector<std::unique_ptr<physics::Body>>& masses) {
  names = other.names;
  lineage = other.lineage;
  generations = other.generations;
  free_indices = other.free_indices;
  next_model = other.next_model;
  newest = other.newest;
  for (const auto& model : other.models) {
    models.push_back(std::make_unique<LoadedModel>());
    models.back()->info = model->info;
  }
  std::unordered_map<const Entry*, Entry*> copies = {{nullptr, nullptr}};
  for (const auto& entry : other.entries) {
    auto copy = std::make_unique<Entry>();
    copy->info = entry->info;
    copy->identifier = entry->identifier;
    copy->own_identifier = entry->own_identifier;
    copy->conflict_number = entry->conflict_number;
    copy->name_space = entry->name_space;
    copy->scale = entry->scale;
    copy->wanted_parent = entry->wanted_parent;
    copy->row = entry->row;
    if (state::info_of(entry->info.kind).has_mass) {
      // The live one belongs to the physics thread.
      physics::BodyDefinition mass;
      const auto& row = entry->row_as<state::BodyInfo>();
      mass.mass = row.mass;
      mass.inertia = row.inertia;
      masses.push_back(std::make_unique<physics::Body>(mass));
      copy->physics_body = masses.back().get();
    }
    copies.emplace(entry.get(), copy.get());
    entries.push_back(std::move(copy));
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i]->parent = copies.at(other.entries[i]->parent);
    entries[i]->child = copies.at(other.entries[i]->child);
  }
}

base::Diagnostics Catalogue::check_load(const scene::Model& description, const LoadOptions& load_options) const {
  Findings findings(description.file);
  CommandTable commands;  // nobody commands what is not there
  std::vector<std::unique_ptr<physics::Body>> masses;
  Impl copy(impl_->options, commands, impl_->meshes);
  copy.stand_in_for(*impl_, masses);
  copy.load(description, load_options, findings);
  while (!copy.entries.empty()) copy.entries.pop_back();  // joints before their bodies
  copy.bodies.trim();
  return findings.take();
}

}  // namespace ambf::model
