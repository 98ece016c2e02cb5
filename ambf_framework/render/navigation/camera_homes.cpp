#include "render/navigation/camera_homes.h"

namespace ambf::render {

namespace {

std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }

}  // namespace

void CameraHomes::take(const state::Frame& frame) {
  const state::Structure& structure = *frame.structure;
  if (structure.version == structure_version_) return;
  structure_version_ = structure.version;
  std::map<std::uint64_t, math::Pose> homes;
  for (std::size_t slot = 0; slot < structure.cameras.size(); ++slot) {
    const std::uint64_t key = key_of(structure.objects[structure.cameras[slot].object].id);
    const auto known = homes_.find(key);
    homes.emplace(key, known != homes_.end() ? known->second : frame.cameras[slot].T_parent_camera);
  }
  homes_ = std::move(homes);
}

math::Pose CameraHomes::home(state::ObjectId camera) const {
  const auto known = homes_.find(key_of(camera));
  return known != homes_.end() ? known->second : math::Pose{};
}

}  // namespace ambf::render
