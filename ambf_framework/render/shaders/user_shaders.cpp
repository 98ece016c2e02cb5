#include "render/shaders/user_shaders.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <sstream>

#include "render/shaders/detail/shader_shim.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

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

// Drivers write "0:12(3): error: ..." or "0(12) : error ...": the number after the first colon or bracket.
int line_of(const std::string& words) {
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    if (words[i - 1] != '0' || (words[i] != ':' && words[i] != '(')) continue;
    if (std::isdigit(static_cast<unsigned char>(words[i + 1])) != 0) return std::atoi(words.c_str() + i + 1);
  }
  return 0;
}

// The first error among the compiler's messages, and how many more there are: one line.
std::string first_error(const std::string& messages) {
  std::istringstream lines(messages);
  std::string first, error;
  int more = 0;
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())) != 0) line.pop_back();
    if (line.empty()) continue;
    if (first.empty()) first = line;
    if (line.find("error") == std::string::npos) continue;
    more += error.empty() ? 0 : 1;
    if (error.empty()) error = line;
  }
  if (error.empty()) return first;
  return more == 0 ? error : error + " (and " + std::to_string(more) + (more == 1 ? " more error)" : " more errors)");
}

SamplerUse use_of(const std::string& name, GLenum type) {
  if (type == GL_SAMPLER_CUBE) return SamplerUse::sky;
  if (type == GL_SAMPLER_3D) return SamplerUse::volume;
  if (type == GL_SAMPLER_2D_SHADOW) return SamplerUse::shadow_compare;
  if (name == "ambf_NearerDepth") return SamplerUse::nearer_depth;
  if (name == "ambf_OpaqueDepth") return SamplerUse::opaque_depth;
  if (name == "shadowMap") return SamplerUse::shadow_depth;
  if (name == "normalMap") return SamplerUse::normal_map;
  // Maps that ADF's bodies do not have: not a metal; rough, unoccluded.
  if (name == "metallicMap") return SamplerUse::black;
  if (name == "roughnessMap" || name == "aoMap" || name == "specularMap") return SamplerUse::white;
  return SamplerUse::color;
}

}  // namespace

void UserShaders::report(base::Severity severity, const std::string& file, int line, std::string message) {
  if (!reported_.insert(file + ":" + std::to_string(line) + message).second) return;
  base::Diagnostic finding;
  finding.severity = severity;
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
    report(base::Severity::warning, *file, 0, "shader cannot be read: " + why);
    return nullptr;
  }
  const ShimmedShaders shimmed = shim(vertex, fragment);
  auto made = std::make_unique<UserProgram>();
  made->wants_tangents = shimmed.wants_tangents;
  std::vector<const char*> attributes;
  for (const std::string& name : shimmed.attributes) attributes.push_back(name.c_str());
  if (!made->program.build(gl_, shimmed.vertex, shimmed.fragment, attributes, why)) {
    const bool in_fragment = why.rfind("fragment", 0) == 0;
    const std::string reason = first_error(why);
    report(base::Severity::error, in_fragment ? files.fragment : files.vertex, line_of(reason), reason);
    return nullptr;
  }
  for (const auto& [name, type] : made->program.samplers()) made->samplers.emplace_back(name, use_of(name, type));
  return made;
}

}  // namespace ambf::render
