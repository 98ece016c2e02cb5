#include "render/shaders/user_shaders.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>

#include "render/shaders/detail/shader_shim.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

float f(double x) { return static_cast<float>(x); }

bool read_text(const std::string& path, std::string& text, std::string& why) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    why = std::strerror(errno);
    return false;
  }
  text.resize(kMaxBytes + 1);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() <= kMaxBytes) return true;
  why = "larger than 1 MiB";
  return false;
}

// Drivers say "0:12(3): error: ..." or "0(12) : error ...": the number after the first colon or bracket.
int line_of(const std::string& words) {
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    if (words[i - 1] != '0' || (words[i] != ':' && words[i] != '(')) continue;
    if (std::isdigit(static_cast<unsigned char>(words[i + 1])) != 0) return std::atoi(words.c_str() + i + 1);
  }
  return 0;
}

SamplerUse use_of(const std::string& name, GLenum type) {
  if (type == GL_SAMPLER_CUBE) return SamplerUse::sky;
  if (type == GL_SAMPLER_2D_SHADOW) return SamplerUse::shadow_compare;
  if (name == "ambf_NearerDepth") return SamplerUse::nearer_depth;
  if (name == "ambf_OpaqueDepth") return SamplerUse::opaque_depth;
  if (name == "shadowMap") return SamplerUse::shadow_depth;
  if (name == "normalMap") return SamplerUse::normal_map;
  return SamplerUse::color;
}

}  // namespace

void UserShaders::report(const std::string& file, int line, std::string message) {
  base::Diagnostic finding;
  finding.severity = base::Severity::error;
  finding.file = file;
  finding.line = line;
  finding.message = std::move(message);
  finding.hint = instead_;
  findings_.push_back(std::move(finding));
}

UserProgram* UserShaders::program(const ShaderPair& files) {
  auto known = known_.find(files);
  if (known == known_.end()) known = known_.emplace(files, Known{compile(files), true}).first;
  known->second.used = true;
  return known->second.program.get();
}

void UserShaders::forget_unused() {
  std::erase_if(known_, [](const auto& entry) { return !entry.second.used; });
  for (auto& [files, known] : known_) known.used = false;
}

std::unique_ptr<UserProgram> UserShaders::compile(const ShaderPair& files) {
  std::string vertex, fragment, why;
  for (const auto& [file, text] : {std::pair{&files.vertex, &vertex}, std::pair{&files.fragment, &fragment}}) {
    if (read_text(*file, *text, why)) continue;
    report(*file, 0, "shader cannot be read: " + why);
    return nullptr;
  }
  const ShimmedShaders shimmed = shim(vertex, fragment);
  auto made = std::make_unique<UserProgram>();
  made->wants_tangents = shimmed.wants_tangents;
  std::vector<const char*> attributes;
  for (const std::string& name : shimmed.attributes) attributes.push_back(name.c_str());
  if (!made->program.build(gl_, shimmed.vertex, shimmed.fragment, attributes, why)) {
    const bool in_fragment = why.rfind("fragment", 0) == 0;
    while (!why.empty() && std::isspace(static_cast<unsigned char>(why.back())) != 0) why.pop_back();
    report(in_fragment ? files.fragment : files.vertex, line_of(why), why);
    return nullptr;
  }
  for (const auto& [name, type] : made->program.samplers()) made->samplers.emplace_back(name, use_of(name, type));
  return made;
}

void set_fixed_function_picture(Program& p, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                                const std::vector<Light>& lights) {
  p.set("ambf_ProjectionMatrix", eye_to_clip);
  const Mat4 identity = to_matrix({});
  for (int i = 0; i < 8; ++i) p.set(("ambf_TextureMatrix[" + std::to_string(i) + "]").c_str(), identity);
  p.set("ambf_LightModel.ambient", 0.2F, 0.2F, 0.2F, 1.0F);
  p.set("ambf_Fog.color", 0.0F, 0.0F, 0.0F, 0.0F);
  p.set("ambf_Fog.end", 1.0F);
  p.set("ambf_Fog.scale", 1.0F);
  for (std::size_t i = 0; i < kMaxLights; ++i) {
    const std::string light = "ambf_LightSource[" + std::to_string(i) + "].";
    const auto set = [&](const char* name, auto... values) { p.set((light + name).c_str(), values...); };
    const float on = i < lights.size() ? 1.0F : 0.0F;
    set("ambient", 0.0F, 0.0F, 0.0F, 1.0F);
    set("diffuse", on, on, on, 1.0F);
    set("specular", on, on, on, 1.0F);
    if (i >= lights.size()) {
      set("constantAttenuation", 1.0F);
      set("position", 0.0F, 0.0F, 1.0F, 0.0F);
      continue;
    }
    const Light& from = lights[i];
    const auto at = transform(world_to_eye, from.point_world);
    const std::array<float, 16>& m = world_to_eye.m;
    const math::Vec3& d = from.direction_world;
    const double direction[3] = {m[0] * d.x + m[4] * d.y + m[8] * d.z, m[1] * d.x + m[5] * d.y + m[9] * d.z,
                                 m[2] * d.x + m[6] * d.y + m[10] * d.z};
    if (from.kind == state::LightType::directional) {
      set("position", f(-direction[0]), f(-direction[1]), f(-direction[2]), 0.0F);
    } else {
      set("position", f(at[0]), f(at[1]), f(at[2]), 1.0F);
    }
    set("spotDirection", f(direction[0]), f(direction[1]), f(direction[2]));
    const bool spot = from.kind == state::LightType::spot;
    set("spotExponent", spot ? f(from.spot_exponent) : 0.0F);
    set("spotCutoff", spot ? f(from.cutoff_angle_rad * 180.0 / std::numbers::pi) : 180.0F);
    set("spotCosCutoff", spot ? f(std::cos(from.cutoff_angle_rad)) : -1.0F);
    set("constantAttenuation", f(from.attenuation_constant));
    set("linearAttenuation", f(from.attenuation_linear));
    set("quadraticAttenuation", f(from.attenuation_quadratic));
  }
}

// The file's numbers, as the display shows them: old shaders know no linear light.
void set_fixed_function_material(Program& p, const Surface& surface) {
  const auto set = [&](const char* name, const std::array<float, 3>& c) {
    p.set(name, c[0], c[1], c[2], surface.alpha);
  };
  set("ambf_FrontMaterial.emission", surface.given.emission);
  set("ambf_FrontMaterial.ambient", surface.given.ambient);
  set("ambf_FrontMaterial.diffuse", surface.given.diffuse);
  set("ambf_FrontMaterial.specular", surface.given.specular);
  p.set("ambf_FrontMaterial.shininess", surface.shininess);
}

void set_fixed_function_place(Program& p, const Mat4& world_to_eye, const Mat4& eye_to_clip,
                              const InstanceData& instance) {
  Mat4 part_to_world;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column)
      part_to_world.m[4 * column + row] = instance.rows[4 * row + column];
  }
  part_to_world.m[15] = 1.0F;
  const Mat4 part_to_eye = world_to_eye * part_to_world;
  p.set("ambf_ModelViewMatrix", part_to_eye);
  p.set("ambf_ModelViewProjectionMatrix", eye_to_clip * part_to_eye);
  // Inverse and transposed; scales are the same along all axes, so it is the turned part over the square of the scale.
  const std::array<float, 16>& m = part_to_eye.m;
  const float square = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
  std::array<float, 9> normal{};
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row) normal[3 * column + row] = m[4 * column + row] / square;
  }
  p.set("ambf_NormalMatrix", normal);
}

}  // namespace ambf::render
