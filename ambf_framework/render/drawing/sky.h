// The skybox as a texture: six pictures, decoded aside, shown when all are there. Shared by the windows of a share
// group. Main thread, context current. Private to render/.
#pragma once

#include <array>
#include <map>
#include <string>

#include "base/diagnostic.h"
#include "render/gl/handle.h"
#include "render/images/texture_loader.h"
#include "render/scene/surface.h"
#include "state/view.h"

namespace ambf::render {

// Light from the surroundings, without direction but for up and down. Linear.
struct Surroundings {
  LinearColor up{0.38F, 0.40F, 0.43F};     // bluish white
  LinearColor down{0.15F, 0.145F, 0.14F};  // warm grey, from the ground
};

class Sky {
 public:
  explicit Sky(const Gl& gl);

  // Brings the texture in line with `skybox`; to be called before each picture. Findings about pictures are returned
  // once.
  base::Diagnostics take(const state::Skybox& skybox);
  base::Diagnostics finish();  // waits for the pictures

  bool shown() const { return static_cast<bool>(texture_); }
  // Faces as our shaders expect them: +x right, +y top, +z front, upright; seen from inside.
  GLuint texture() const { return texture_.name(); }
  // For users' sky shaders, as the original hands them over: the same mirrored in y (top at -y), in display values.
  GLuint texture_for_users() const { return user_texture_.name(); }
  const Surroundings& surroundings() const { return surroundings_; }

 private:
  base::Diagnostics collect();
  GlTexture upload(bool for_users) const;

  const Gl& gl_;
  TextureLoader loader_;
  state::Skybox asked_;
  std::map<std::string, Decoded> pictures_;  // until all are there
  GlTexture texture_, user_texture_;
  Surroundings surroundings_;
};

}  // namespace ambf::render
