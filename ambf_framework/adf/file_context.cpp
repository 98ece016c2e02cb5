#include "adf/detail/file_context.h"

#include <algorithm>
#include <cmath>

#include "adf/detail/bind.h"
#include "adf/detail/files.h"
#include "adf/detail/key_check.h"
#include "adf/detail/scalars.h"
#include "math/rotation.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

// Shipped files give axes with four digits.
constexpr double kAxisTolerance = 1e-3;
// Below this an axis has no direction.
constexpr double kShortestAxis = 1e-9;

// "BODY Link 1" -> "Link1": what a block without name is called.
std::string name_from_identifier(const std::string& identifier) {
  std::string name = identifier;
  for (const char* prefix : {"BODY ", "JOINT "}) {
    if (name.starts_with(prefix)) {
      name.erase(0, std::string_view(prefix).size());
      break;
    }
  }
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
}

}  // namespace

std::string NameBook::take(const std::string& name) {
  if (taken_.insert(name).second) return {};
  for (std::size_t& number = next_[name];;) {
    std::string text = std::to_string(++number);
    if (taken_.insert(name + text).second) return text;
  }
}

scene::Identity parse_identity(const Block& block, const FileContext& file, NameBook& names) {
  auto identity = read<scene::Identity>(block.fields.value(), scene::group::kIdentity, file.options.defaults);
  identity.where = {block.where.line, block.where.column};
  identity.identifier = block.identifier;
  identity.name_space = scene::join_namespace(file.name_space, block.fields.text("namespace"));
  std::string name = block.fields.text("name");
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  if (name.empty()) {
    name = name_from_identifier(block.identifier);
    file.report.information(block.where, "name", "missing; the object is called " + in_quotes(name));
  }
  // Objects differ in namespace + name; the number goes behind the name (ADF 1.4).
  const std::string number = names.take(identity.name_space + name);
  identity.name = name + number;
  if (!number.empty()) {
    file.report.warning(block.fields.mark("name"), "name",
                        "another object is called " + in_quotes(identity.name_space + name) + " already",
                        "this one is renamed to " + in_quotes(identity.name));
  }
  if (identity.rate_low_hz > identity.rate_high_hz) {
    file.report.warning(block.fields.mark("publish frequency"), "publish frequency", "low is above high",
                        "they are exchanged");
    std::swap(identity.rate_low_hz, identity.rate_high_hz);
  }
  return identity;
}

scene::Shaders parse_shaders(const Fields& block, std::string_view key, const FileContext& file) {
  if (!block.has(key)) return {};
  const Fields map = block.map(key);
  scene::Shaders shaders{resolve(file.folder, map.text("path")), map.text("vertex"), map.text("fragment")};
  if (!file.options.look_for_files) return shaders;
  bool found = true;
  for (const char* part : {"vertex", "fragment"}) {
    const std::string path = resolve(shaders.path, map.text(part));
    if (!find_file({path}).empty()) continue;
    file.report.warning(map.mark(part), std::string(key) + "/" + part, "no such file: " + shown_path(path),
                        "the default shading is used");
    found = false;
  }
  return found ? shaders : scene::Shaders{};
}

std::optional<math::Vec3> parse_axis(const Fields& block, std::string_view key, const math::Vec3& fallback,
                                     Report& report) {
  const math::Vec3 axis = block.vector(key, fallback);
  const double length = math::norm(axis);
  if (!(length > kShortestAxis) || !std::isfinite(length)) {
    report.error(block.mark(key), std::string(key),
                 "expected a direction, found the zero vector (or one beyond all measure)", "give a unit vector");
    return std::nullopt;
  }
  if (std::abs(length - 1.0) > kAxisTolerance) {
    report.warning(block.mark(key), std::string(key), "is no unit vector: its length is " + std::to_string(length),
                   "it is normalised");
  }
  return axis / length;
}

}  // namespace ambf::adf
