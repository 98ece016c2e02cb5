// Shaders that users' files name for bodies, models, worlds, cameras and skies, written in old GLSL or new
// (shader_shim.h). Shared by the windows of a share group. A shader that does not compile is reported once, in one
// line, and the body drawn with our shading. Main thread, context current. Private to render/.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "render/gl/program.h"
#include "render/shaders/shader_pair.h"

namespace ambf::render {

// What a sampler of a user's shader reads. `volume`: no renderer of volumes exists, such a sampler reads black.
enum class SamplerUse {
  color,
  normal_map,
  shadow_compare,
  shadow_depth,
  sky,
  nearer_depth,
  opaque_depth,
  white,
  black,
  volume
};

struct UserProgram {
  Program program;
  std::vector<std::pair<std::string, SamplerUse>> samplers;
  bool wants_tangents = false;
};

class UserShaders {
 public:
  // `instead`: what findings say is done without the shader.
  explicit UserShaders(const Gl& gl, const char* instead = "drawn with the program's own shading meanwhile")
      : gl_(gl), instead_(instead) {}

  // Null when the files cannot be read or compiled. Compiled on first use.
  UserProgram* program(const ShaderPair& files);
  base::Diagnostics take_findings() { return std::exchange(findings_, {}); }
  // Frees those that were not asked for since the last call.
  void forget_unused();

 private:
  struct Known {
    std::unique_ptr<UserProgram> program;
    bool used = true;
  };
  std::unique_ptr<UserProgram> compile(const ShaderPair& files);

  void report(base::Severity severity, const std::string& file, int line, std::string message);

  const Gl& gl_;
  const char* const instead_;
  std::map<ShaderPair, Known> known_;
  std::set<std::string> reported_;
  base::Diagnostics findings_;
};

}  // namespace ambf::render
