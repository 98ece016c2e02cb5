// The compiled shaders that all windows share; variants for what a picture needs are compiled on first use. Main thread, context
// current. Private to render/.
#pragma once

#include <map>
#include <string>

#include "render/gl/program.h"
#include "render/shaders.h"

namespace ambf::render {

class Programs {
 public:
  explicit Programs(const Gl& gl) : gl_(gl) {}
  bool build(std::string& why);

  Program& mesh(const MeshVariant& variant);
  Program& background() { return background_; }

 private:
  const Gl& gl_;
  std::map<MeshVariant, Program> meshes_;
  Program background_;
};

}  // namespace ambf::render
