// What all windows of one share group have in common: meshes, textures, shaders and shadow maps, and what there is to
// draw. One for each group of contexts that share objects (windows), one for each context that is alone (off-screen);
// painters (picture_composer.h) add what belongs to a single context. Main thread (or whichever thread owns the
// contexts), one of the group's contexts current. Private to render/.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "render/drawing/gpu_store.h"
#include "render/drawing/shadow_map.h"
#include "render/drawing/sky.h"
#include "render/scene/scene_batches.h"
#include "render/shaders/programs.h"
#include "render/shaders/user_shaders.h"

namespace ambf::render {

class SharedStore {
 public:
  explicit SharedStore(const Gl& gl) : gpu_(gl), programs_(gl), user_shaders_(gl), shadows_(gl), sky_(gl) {}
  bool build(std::string& why);  // compiles the shaders; false with the compiler's words

  // Brings meshes and textures in line with `structure`; to be called before each picture, since textures arrive
  // later. Findings are about textures and users' shaders.
  base::Diagnostics take(const state::Structure& structure);
  // Brings what is drawn of soft bodies to these nodes (ScenePoses::nodes); before what paints or measures.
  void pose(const std::vector<math::Vec3>& nodes);
  // Waits for the textures.
  base::Diagnostics finish_textures();

  const SceneBatches& scene() const { return scene_; }  // of what was taken last
  // Greater once what is drawn of an equal structure looks otherwise: textures came.
  std::uint64_t looks_version() const { return 2 * gpu_.textures_taken() + (sky_.shown() ? 1 : 0); }
  const GpuStore& gpu() const { return gpu_; }
  Programs& programs() { return programs_; }
  UserShaders& user_shaders() { return user_shaders_; }
  ShadowMap& shadows() { return shadows_; }
  const Sky& sky() const { return sky_; }
  const ShaderPair& sky_shader() const { return sky_shader_; }

 private:
  GpuStore::Wishes wishes_of_user_shaders(const state::Structure& structure);

  GpuStore gpu_;
  Programs programs_;
  UserShaders user_shaders_;
  ShadowMap shadows_;
  Sky sky_;
  ShaderPair sky_shader_;
  MeshIdentity meshes_;
  SceneBatches scene_;
  bool scene_made_ = false;
};

}  // namespace ambf::render
