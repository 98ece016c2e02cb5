// Cameras: a pose in a parent, and a lens.
#include <variant>

#include "model/detail/view_builder.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"

namespace ambf::model {
namespace {

using state::ObjectKind;

struct LiveCamera final : LivePlaced {
  state::Lens lens;
};

struct SavedCamera final : SavedPlaced {
  state::Lens lens;
};

class CameraKind final : public PlacedKind {
 public:
  CameraKind() : PlacedKind(ObjectKind::camera) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    for (const scene::Camera& camera : model.description.cameras) {
      auto live = std::make_unique<LiveCamera>();
      state::CameraInfo row = camera_info(camera);
      live->lens = row.lens;
      if (camera.parent.empty()) row.look_at = options.T_world_model * camera.look_at;
      row.frames_scene = model.defaults.contains(camera.identity.identifier);
      Entry* entry =
          add(all, std::move(live), camera.identity, camera.parent, camera_pose(camera), model, options, findings);
      if (entry != nullptr) entry->row = std::move(row);
    }
  }

  void describe_world(const scene::World& world, LoadedModel& model) const override {
    model.description.cameras = world.cameras;
    if (!world.cameras.empty()) return;
    model.description.cameras.push_back(default_camera(world.name_space));
    model.defaults.insert(model.description.cameras.back().identity.identifier);
  }

  void erase_block(scene::Model& model, const std::string& identifier) const override {
    model::erase_block(model.cameras, identifier);
  }
  void each_parent(const scene::Model& model, const ParentVisit& visit) const override {
    for (const scene::Camera& camera : model.cameras) visit(camera.identity, camera.parent);
  }

  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    state::CameraInfo row = entry.row_as<state::CameraInfo>();
    set_placed(row, entry, draft);
    structure.cameras.push_back(std::move(row));
  }

  // The camera lock of the dissertation's Sec. 3.4.3: the first to move a camera holds it until he lets go.
  bool excludes_others(const state::Command& command) const override {
    return std::get<state::PoseCommand>(command).enabled;
  }

  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    for (std::uint32_t slot = 0; slot < frame.cameras.size(); ++slot) {
      const LiveCamera& camera = self(live, slot);
      frame.cameras[slot] = {camera.T_parent, pose(live, slot), camera.lens, camera.active};
    }
  }

  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    PlacedKind::reset(live, slot);
    self(live, slot).lens = live.structure->cameras[slot].lens;
  }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedCamera>(); }
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    static_cast<SavedCamera&>(saved).lens = self(live, slot).lens;
  }
  using PlacedKind::transfer;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    state::Lens& lens = static_cast<SavedCamera&>(saved).lens;
    for (double* number : {&lens.near_m, &lens.far_m, &lens.field_of_view_rad, &lens.orthographic_width_m,
                           &lens.eye_separation_m, &lens.focal_length_m, &lens.optics.focal_ratio,
                           &lens.optics.axis_right, &lens.optics.axis_down, &lens.optics.skew})
      archive.number(*number, -kMaxSaved, kMaxSaved, "the lens");
    archive.flag(lens.orthographic, "the projection");
    archive.flag(lens.stereo, "the mode");
    if (archive.reads()) archive.require(state::check(lens).empty(), state::check(lens));
  }
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    self(live, slot).lens = static_cast<const SavedCamera&>(saved).lens;
  }

  LiveCamera& self(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveCamera&>(placed(live, slot));
  }
};

}  // namespace

std::unique_ptr<Kind> make_camera_kind() { return std::make_unique<CameraKind>(); }

void LiveWorld::set_lens(state::ObjectId camera, const state::Lens& lens) {
  LiveObject* object = impl_->find(camera, ObjectKind::camera);
  if (object == nullptr) return;
  static_cast<LiveCamera&>(*object).lens = lens;
  impl_->changed = true;
}

}  // namespace ambf::model
