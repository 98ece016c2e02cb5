// Lights: a pose in a parent, and a beam.
#include "model/detail/view_builder.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"

namespace ambf::model {
namespace {

using state::ObjectKind;

struct LiveLight final : LivePlaced {
  state::Beam beam;
};

struct SavedLight final : SavedPlaced {
  state::Beam beam;
};

class LightKind final : public PlacedKind {
 public:
  LightKind() : PlacedKind(ObjectKind::light) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    for (const scene::Light& light : model.description.lights) {
      auto live = std::make_unique<LiveLight>();
      state::LightInfo row = light_info(light);
      live->beam = row.beam;
      Entry* entry =
          add(all, std::move(live), light.identity, light.parent, light_pose(light), model, options, findings);
      if (entry != nullptr) entry->row = std::move(row);
    }
  }

  void describe_world(const scene::World& world, LoadedModel& model) const override {
    model.description.lights = world.lights;
    if (world.lights.empty()) model.description.lights.push_back(default_light(world.name_space));
  }

  void erase_block(scene::Model& model, const std::string& identifier) const override {
    model::erase_block(model.lights, identifier);
  }
  void each_parent(const scene::Model& model, const ParentVisit& visit) const override {
    for (const scene::Light& light : model.lights) visit(light.identity, light.parent);
  }

  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    state::LightInfo row = entry.row_as<state::LightInfo>();
    set_placed(row, entry, draft);
    structure.lights.push_back(std::move(row));
  }

  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    for (std::uint32_t slot = 0; slot < frame.lights.size(); ++slot) {
      const LiveLight& light = self(live, slot);
      frame.lights[slot] = {light.T_parent, pose(live, slot), light.beam, light.active};
    }
  }

  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    PlacedKind::reset(live, slot);
    self(live, slot).beam = live.structure->lights[slot].beam;
  }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedLight>(); }
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    static_cast<SavedLight&>(saved).beam = self(live, slot).beam;
  }
  using PlacedKind::transfer;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    state::Beam& beam = static_cast<SavedLight&>(saved).beam;
    archive.choice(beam.type, 0, static_cast<int>(state::LightType::directional), "the type of light");
    for (double* number : {&beam.cutoff_angle_rad, &beam.spot_exponent, &beam.attenuation_constant,
                           &beam.attenuation_linear, &beam.attenuation_quadratic})
      archive.number(*number, -kMaxSaved, kMaxSaved, "the beam");
    archive.choice(beam.shadow_quality, 0, 5, "the shadow quality");
    if (archive.reads()) archive.require(state::check(beam).empty(), state::check(beam));
  }
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    self(live, slot).beam = static_cast<const SavedLight&>(saved).beam;
  }

  LiveLight& self(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveLight&>(placed(live, slot));
  }
};

}  // namespace

std::unique_ptr<Kind> make_light_kind() { return std::make_unique<LightKind>(); }

void LiveWorld::set_beam(state::ObjectId light, const state::Beam& beam) {
  LiveObject* object = impl_->find(light, ObjectKind::light);
  if (object == nullptr) return;
  static_cast<LiveLight&>(*object).beam = beam;
  impl_->changed = true;
}

}  // namespace ambf::model
