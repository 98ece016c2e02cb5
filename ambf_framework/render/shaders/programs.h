// The compiled shaders that all windows share; variants for what a picture needs are compiled on first use. Main
// thread, context current. Private to render/.
#pragma once

#include <map>
#include <string>

#include "render/gl/program.h"
#include "render/shaders/shaders.h"

namespace ambf::render {

class Programs {
 public:
  explicit Programs(const Gl& gl) : gl_(gl) {}
  bool build(std::string& why);

  Program& mesh(const MeshVariant& variant);
  Program& background(bool sky) { return sky ? skybox_ : gradient_; }
  Program& occlusion() { return occlusion_; }
  Program& occlusion_blur() { return occlusion_blur_; }
  Program& layer() { return layer_; }

 private:
  const Gl& gl_;
  std::map<MeshVariant, Program> meshes_;
  Program gradient_, skybox_, occlusion_, occlusion_blur_, layer_;
};

}  // namespace ambf::render
