// Shaders that users' files name for bodies, models, worlds, cameras and skies, written in old GLSL or new (shader_shim.h). Shared by the
// windows of a share group. What does not compile is reported once, and the body drawn with our shading. Main thread, context current.
// Private to render/.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "render/gl/program.h"
#include "render/scene/draw_scene.h"
#include "render/scene/lights.h"

namespace ambf::render {

// What a sampler of theirs is given.
enum class SamplerUse { color, normal_map, shadow_compare, shadow_depth, sky, nearer_depth, opaque_depth };

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

  void report(const std::string& file, int line, std::string message);

  const Gl& gl_;
  const char* const instead_;
  std::map<ShaderPair, Known> known_;
  base::Diagnostics findings_;
};

// The uniforms of the fixed-function state (shader_shim.h), of the program in use.
void set_fixed_function_picture(Program& program, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                                const std::vector<Light>& lights);
void set_fixed_function_material(Program& program, const Surface& surface);
void set_fixed_function_place(Program& program, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                              const InstanceData& instance);

}  // namespace ambf::render
