#include "mesh/formats/detail/read_mtl.h"

#include <algorithm>
#include <map>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

constexpr std::size_t kMaxMaterials = 10000;

class MtlReader {
 public:
  MtlReader(const std::string& path, ReadContext& context, std::vector<Material>& materials)
      : path_(path), context_(context), materials_(materials) {
    for (std::size_t i = 0; i < materials.size(); ++i) by_name_[materials[i].name] = i;
  }

  void read(std::string_view bytes) {
    std::string_view line;
    while (take_line(bytes, line)) {
      ++line_;
      std::string_view rest = trim(line);
      const std::string_view keyword = take_word(rest);
      if (!keyword.empty() && keyword.front() != '#') read_statement(keyword, trim(rest));
    }
  }

 private:
  void read_statement(std::string_view keyword, std::string_view rest) {
    if (equal_ignoring_case(keyword, "newmtl")) {
      begin_material(rest);
      return;
    }
    if (current_ == kNone) return;
    Material& m = materials_[current_];
    if (equal_ignoring_case(keyword, "Ka")) read_color(rest, m.ambient);
    if (equal_ignoring_case(keyword, "Kd")) read_color(rest, m.diffuse);
    if (equal_ignoring_case(keyword, "Ks")) read_color(rest, m.specular);
    if (equal_ignoring_case(keyword, "Ke")) read_color(rest, m.emission);
    if (equal_ignoring_case(keyword, "Ns")) read_number(rest, 0.0F, 1000.0F, m.shininess);
    if (equal_ignoring_case(keyword, "d")) {
      if (starts_with_ignoring_case(rest, "-halo")) take_word(rest);
      read_number(rest, 0.0F, 1.0F, m.diffuse.a);
    }
    if (equal_ignoring_case(keyword, "Tr")) {
      float transparency = 1.0F - m.diffuse.a;
      read_number(rest, 0.0F, 1.0F, transparency);
      m.diffuse.a = 1.0F - transparency;
    }
    if (equal_ignoring_case(keyword, "map_Kd")) read_texture(rest, m.texture_file);
    if (equal_ignoring_case(keyword, "bump") || equal_ignoring_case(keyword, "map_bump") ||
        equal_ignoring_case(keyword, "norm")) {
      read_texture(rest, m.normal_map_file);
    }
    // Metals: the physically based extension says it with Pm; exporters without it (Blender's) write the mirroring
    // model 3.
    if (equal_ignoring_case(keyword, "Pm")) {
      read_number(rest, 0.0F, 1.0F, m.metallic);
      says_metallic_ = true;
    }
    if (equal_ignoring_case(keyword, "illum") && !says_metallic_) m.metallic = take_word(rest) == "3" ? 1.0F : 0.0F;
    // Other keywords (Ni, reflection maps, further physically based terms) do not change how we draw.
  }

  void begin_material(std::string_view name) {
    const auto known = by_name_.find(name);
    current_ = known == by_name_.end() ? kNone : known->second;
    if (current_ == kNone) {
      if (materials_.size() >= kMaxMaterials) {
        if (!full_) warn("there are more than " + std::to_string(kMaxMaterials) + " materials; the rest is ignored");
        full_ = true;
        return;
      }
      current_ = materials_.size();
      materials_.emplace_back();
      by_name_.emplace(std::string(name), current_);
    }
    materials_[current_] = Material{};
    says_metallic_ = false;
    materials_[current_].name = std::string(name);
  }

  void read_color(std::string_view rest, Color& color) {
    float values[3] = {0.0F, 0.0F, 0.0F};
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = take_word(rest);
      if (word.empty() && i == 1) {  // one number: grey
        values[1] = values[2] = values[0];
        break;
      }
      if (!parse_float(word, values[i])) {
        warn("expected a colour of three numbers, found " + (word.empty() ? "the end of the line" : in_quotes(word)));
        return;
      }
    }
    color.r = std::clamp(values[0], 0.0F, 1.0F);
    color.g = std::clamp(values[1], 0.0F, 1.0F);
    color.b = std::clamp(values[2], 0.0F, 1.0F);
  }

  void read_number(std::string_view rest, float min, float max, float& out) {
    float value = 0.0F;
    const std::string_view word = take_word(rest);
    if (!parse_float(word, value)) {
      warn("expected a number, found " + (word.empty() ? "the end of the line" : in_quotes(word)));
      return;
    }
    out = std::clamp(value, min, max);
  }

  // "[-option values...] file name with spaces"
  void read_texture(std::string_view rest, std::string& out) {
    rest = trim(rest);
    while (!rest.empty() && rest.front() == '-') {
      std::string_view after = rest;
      const std::string_view option = take_word(after);
      static constexpr std::string_view kOneWord[] = {"-blendu", "-blendv",  "-bm",     "-boost", "-cc",
                                                      "-clamp",  "-imfchan", "-texres", "-type"};
      static constexpr std::string_view kNumbers[] = {"-mm", "-o", "-s", "-t"};
      if (std::find(std::begin(kOneWord), std::end(kOneWord), option) != std::end(kOneWord)) {
        take_word(after);
      } else if (std::find(std::begin(kNumbers), std::end(kNumbers), option) != std::end(kNumbers)) {
        for (int i = 0; i < 3; ++i) {  // one to three numbers
          std::string_view peek = after;
          float ignored = 0.0F;
          if (!parse_float(take_word(peek), ignored)) break;
          after = peek;
        }
      } else {
        break;  // the file name itself begins with '-'
      }
      rest = trim(after);
    }
    out.clear();
    if (!rest.empty()) out = context_.find_texture(std::string(rest), path_, line_);
  }

  void warn(const std::string& message) {
    if (++warnings_ <= 8) context_.warn_in(path_, message, "mend the line, or export the material again", line_);
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  const std::string& path_;
  ReadContext& context_;
  std::vector<Material>& materials_;
  std::map<std::string, std::size_t, std::less<>> by_name_;
  std::size_t current_ = kNone;
  bool full_ = false, says_metallic_ = false;
  int line_ = 0, warnings_ = 0;
};

}  // namespace

bool read_mtl(std::string_view bytes, const std::string& path, ReadContext& context, std::vector<Material>& materials) {
  MtlReader(path, context, materials).read(bytes);
  return true;
}

}  // namespace ambf::mesh
