#include "render/shared_store.h"

namespace ambf::render {

bool SharedStore::build(std::string& why) { return programs_.build(why) && shadows_.build(why); }

base::Diagnostics SharedStore::take(const state::Structure& structure) {
  if (!scene_made_ || scene_.version != structure.version) {
    scene_made_ = true;
    scene_ = make_draw_scene(structure, meshes_);
    gpu_.prepare(scene_);
  }
  return gpu_.collect();
}

}  // namespace ambf::render
