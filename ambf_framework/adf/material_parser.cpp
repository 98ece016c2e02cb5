// Colours of a body (ADF 9).
#include <algorithm>
#include <cstdint>

#include "adf/detail/bind.h"
#include "adf/detail/body_parser.h"
#include "adf/detail/colors.h"
#include "base/hash.h"

namespace ambf::adf {

namespace {

// `ambient` of a plain colour, as part of the diffuse one.
constexpr double kAmbientOfPlain = 0.5;

// A component in 0..1; more is a misunderstanding (0..255?), and cut off.
double part(const Fields& map, std::string_view key, double fallback, const std::string& path, Report& report) {
  const double value = map.number(key, fallback);
  if (value <= 1.0) return value;
  report.warning(map.mark(key), path + "/" + std::string(key), "expected 0 to 1, found " + std::to_string(value),
                 "it counts as 1");
  return 1.0;
}

// Components above 1 count as 1, with a warning.
void cut(const Fields& owner, std::string_view key, const std::string& path, scene::Color& color, Report& report) {
  if (!owner.has(key)) return;
  const Fields map = owner.map(key);
  const std::string full = path + std::string(key);
  color = {part(map, "r", color.r, full, report), part(map, "g", color.g, full, report),
           part(map, "b", color.b, full, report)};
}

scene::Color scaled(const scene::Color& c, double factor) { return {c.r * factor, c.g * factor, c.b * factor}; }

scene::Material plain(const scene::Color& diffuse, double alpha) {
  scene::Material material;
  material.diffuse = diffuse;
  material.ambient = scaled(diffuse, kAmbientOfPlain);
  material.alpha = alpha;
  return material;
}

scene::Material from_rgba(const Fields& fields, std::string_view key, const std::string& before, Report& report) {
  const std::string path = before + std::string(key);
  const Fields map = fields.map(key);
  const scene::Color diffuse{part(map, "r", 0.0, path, report), part(map, "g", 0.0, path, report),
                             part(map, "b", 0.0, path, report)};
  return plain(diffuse, part(map, "a", 1.0, path, report));
}

scene::Material from_components(const Fields& fields, const std::string& before, const FileContext& file) {
  const std::string whole = before + "color components", path = whole + "/";
  Report& report = file.report;
  const Fields map = fields.map("color components");
  auto material = read<scene::Material>(map.value(), scene::group::kColorComponents, file.options.defaults);
  cut(map, "diffuse", path, material.diffuse, report);
  cut(map, "specular", path, material.specular, report);
  cut(map, "emission", path, material.emission, report);
  if (map.has("ambient")) {
    material.ambient = scaled(material.diffuse, part(map.map("ambient"), "level", 1.0, path + "ambient", report));
  }
  material.alpha = part(map, "transparency", material.alpha, whole, report);
  material.metallic = part(map, "metallic", material.metallic, whole, report);
  return material;
}

std::optional<scene::Material> from_name(const Fields& fields, const std::string& identifier, const std::string& path,
                                         const FileContext& file) {
  const std::string name = fields.text("color"), key = path + "color";
  if (name == "random") {
    file.report.information(fields.mark("color"), key, "the original never read `random`",
                            "here it is a colour that depends on the block's name");
    const scene::NamedColor c = random_color(file.name_space + identifier);
    return plain({c.r, c.g, c.b}, c.a);
  }
  const Mark at = fields.mark("color");
  if (!file.options.colors) {
    file.report.information(at, key, "no colour file was given to look " + in_quotes(name) + " up in",
                            "the launch file's `color config` names one");
    return std::nullopt;
  }
  const auto found = file.options.colors->find(name);
  if (found == file.options.colors->end()) {
    std::vector<std::string> names;
    for (const auto& entry : *file.options.colors) names.push_back(entry.first);
    const std::string near = file.report.nearest(name, names);
    file.report.warning(at, key, "unknown colour " + in_quotes(name),
                        near.empty() ? "see the colour file" : "did you mean `" + near + "`?");
    return std::nullopt;
  }
  const scene::NamedColor& c = found->second;
  return plain({c.r, c.g, c.b}, c.a);
}

}  // namespace

scene::NamedColor random_color(const std::string& seed) {
  std::uint32_t hash = base::fnv1a_32(seed);  // the same colour at each start and on each machine
  hash ^= hash >> 15;
  hash *= 2246822519u;
  hash ^= hash >> 13;
  const auto channel = [hash](unsigned shift) {
    return 0.25 + 0.65 * static_cast<double>((hash >> shift) & 0xffu) / 255.0;
  };
  return {channel(0), channel(8), channel(16), 1.0};
}

std::optional<scene::Material> parse_material(const Fields& fields, const std::string& identifier,
                                              const std::string& path, const FileContext& file) {
  if (!fields.flag("use material", true)) return std::nullopt;
  if (fields.has("color rgba")) return from_rgba(fields, "color rgba", path, file.report);
  if (fields.has("color components")) return from_components(fields, path, file);
  const auto plain_color = fields.find("color");
  if (!plain_color) return std::nullopt;
  if (plain_color->is_map()) return from_rgba(fields, "color", path, file.report);
  return from_name(fields, identifier, path, file);
}

}  // namespace ambf::adf
