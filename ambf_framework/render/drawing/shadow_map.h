// How far each light sees that asks for shadows: depth pictures from its place, tiles of one texture, made once for
// all windows (unless one of them hides bodies) and only when something moved. Main thread, context current. Private
// to render/.
#pragma once

#include <string>

#include "render/drawing/mesh_instancer.h"
#include "render/gl/program.h"
#include "render/scene/lights.h"
#include "render/scene/quality.h"

namespace ambf::render {

// One picture from one light's place. A point light inside the scene has six.
struct ShadowView {
  Mat4 world_to_texture;         // clip cube moved to the tile, depth to [0, 1]
  std::array<float, 4> tile{};   // least u, v, greatest u, v
  std::array<float, 4> lens{};   // near, far, radius of the light in texels at distance 1, 1: parallel rays
  std::array<float, 3> texel{};  // in u and v; in m where the scene is
};

class ShadowMap {
 public:
  explicit ShadowMap(const Gl& gl) : gl_(gl) {}
  bool build(std::string& why);

  // What belongs to the context that is current.
  struct Context {
    const GpuStore& store;
    MeshInstancer& meshes;
    GLuint framebuffer = 0;
  };
  // Brings the map in line with where things and lights are, unless it already shows that, or `quality` lets it lag
  // behind. Leaves the framebuffer binding changed.
  void update(const Context& context, const SceneBatches& scene, const std::vector<math::Pose>& T_world_body,
              const std::vector<BodyLook>& looks, const std::vector<Light>& lights, const Quality& quality);

  // For each light of the last update, and in the order of its views.
  const std::vector<LightVariant>& lights() const { return lights_; }
  const std::vector<ShadowView>& views() const { return views_; }
  GLuint texture() const { return depth_.name(); }
  // Times that it was drawn: for tests.
  std::uint64_t drawn() const { return drawn_; }

 private:
  struct Tile {
    Camera camera;
    int x = 0, y = 0, side = 0;  // texels
    double distance_m = 0.0;     // of the scene
  };
  void plan(const std::vector<Light>& lights, const Sphere& bounds, const Quality& quality);
  void place_tiles();
  void render(const Context& context, const SceneBatches& scene, const std::vector<math::Pose>& T_world_body,
              const std::vector<BodyLook>& looks);
  ShadowView view_of(const Tile& tile, double light_radius_m) const;
  void resize(int width, int height);

  const Gl& gl_;
  Program program_;
  GlTexture depth_;
  DrawList list_;
  std::vector<LightVariant> lights_;
  std::vector<Tile> tiles_;
  std::vector<ShadowView> views_;
  int width_ = 0, height_ = 0;
  std::uint64_t shown_ = 0, seen_ = 0;  // moments: what the map shows, what was asked for last
  std::uint64_t setting_ = 0;           // structure, lights and quality that the map was drawn for
  unsigned missed_ = 0;                 // moments since the map was drawn
  std::uint64_t drawn_ = 0;
};

}  // namespace ambf::render
