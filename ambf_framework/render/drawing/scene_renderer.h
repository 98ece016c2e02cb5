// Scenes in, pictures out: draws what a camera sees on a canvas. Knows no windows, no physics, no control. One a
// context; what contexts share comes from the SharedStore. Main thread. Private to render/.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "render/drawing/detail/occlusion.h"
#include "render/drawing/detail/sky_cube.h"
#include "render/drawing/mesh_instancer.h"
#include "render/drawing/shared_store.h"
#include "render/gl/canvas.h"
#include "render/gl/full_screen.h"
#include "render/gl/program.h"
#include "render/scene/lights.h"

namespace ambf::render {

// Texture units. Nothing is bound to kBlackUnit and kVolumeUnit: what is read from there is black.
inline constexpr int kSurfaceUnit = 0, kShadowUnit = 1, kShadowDepthUnit = 2, kNormalUnit = 3, kSkyUnit = 4,
                     kNearerUnit = 5, kOpaqueUnit = 6, kWhiteUnit = 7, kBlackUnit = 8, kVolumeUnit = 9;

struct Picture {
  Camera camera;
  const std::vector<math::Pose>* T_world_body = nullptr;
  const std::vector<Light>* lights = nullptr;
  bool occlusion = true;
  bool sharp_textures = true;
  bool normal_maps = true;
  bool multipass = false;                         // transparent things that cross each other are seen right
  const std::vector<BodyLook>* looks = nullptr;   // by slot
  const ShaderPair* all_bodies_shader = nullptr;  // instead of each body's own; before black
};

class SceneRenderer {
 public:
  SceneRenderer(const Gl& gl, SharedStore& shared);

  void draw(const Picture& picture, Canvas& canvas);
  MeshInstancer& meshes() { return meshes_; }
  std::size_t instances_drawn() const { return list_.instances.size(); }  // in the last picture

 private:
  void prepare();
  void draw_batches(const Picture& picture, const std::vector<DrawCommand>& commands);
  void draw_ours(const Picture& picture, const std::vector<DrawCommand>& commands);
  void draw_theirs(const Picture& picture, const DrawCommand& command, UserProgram& user);
  void bind_samplers(const Picture& picture, const DrawBatch& batch, UserProgram& user);
  void draw_transparent(const Picture& picture);
  void draw_peeled(const Picture& picture, Canvas& canvas);
  void use_variant(const Picture& picture, const MeshVariant& variant);
  void set_picture(const Picture& picture, Program& program);
  void set_surface(const DrawBatch& batch, float opacity);
  void bind(int unit, GLuint texture);
  void draw_background(const Camera& camera, double aspect);
  bool draw_users_sky(const Picture& picture);

  const Gl& gl_;
  SharedStore& shared_;
  Program* variant_ = nullptr;         // in use
  std::set<const Program*> prepared_;  // know the lights and camera of this picture
  MeshVariant base_;                   // of this picture: what all its batches have in common
  MeshInstancer meshes_;
  FullScreenTriangle screen_;
  SkyCube sky_cube_;
  Occlusion occlusion_;
  Layer peel_a_, peel_b_, peeled_;
  GlSampler depth_reader_;  // reads depths of the shadow map instead of comparing
  GlSampler sharp_;         // of bodies' textures, where the processor draws
  DrawList list_;
  Mat4 world_to_clip_, world_to_eye_, eye_to_clip_;
  std::vector<DrawCommand> ours_, one_;
};

}  // namespace ambf::render
