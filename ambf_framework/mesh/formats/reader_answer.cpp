#include "mesh/formats/reader_answer.h"

#include <algorithm>
#include <cmath>

namespace ambf::mesh {

namespace {

constexpr std::size_t kMaxMaterials = 10000, kMaxNotes = 100, kMaxName = 1000;

bool finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

// Names and notes appear in messages and files: control characters go.
bool clean(std::string& text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text.size() <= kMaxName;
}

bool cut_to(float max, float& value) {
  const bool usable = std::isfinite(value);
  value = std::clamp(value, 0.0F, max);
  return usable;
}

bool clean_material(Material& m, std::size_t pictures) {
  bool good = clean(m.name) && clean(m.texture_file) && clean(m.normal_map_file);
  for (Color* color : {&m.ambient, &m.diffuse, &m.specular, &m.emission}) {
    for (float* part : {&color->r, &color->g, &color->b, &color->a}) good = cut_to(1.0F, *part) && good;
  }
  good = cut_to(1000.0F, m.shininess) && cut_to(1.0F, m.metallic) && good;
  for (const std::string* file : {&m.texture_file, &m.normal_map_file}) {
    if (file->empty() || file->front() != '*') continue;
    const std::string number = file->substr(1);
    const bool digits = !number.empty() && number.size() < 8 &&
                        std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
    good = good && digits && std::stoul(number) < pictures;
  }
  return good;
}

}  // namespace

std::string check(ReaderAnswer& answer, std::uint64_t max_triangles, std::uint64_t max_vertices) {
  for (std::string* text : {&answer.error, &answer.importer}) {
    text->resize(std::min(text->size(), kMaxName));
    clean(*text);
  }
  for (std::vector<std::string>* notes : {&answer.warnings, &answer.information}) {
    notes->resize(std::min(notes->size(), kMaxNotes));
    for (std::string& note : *notes) {
      note.resize(std::min(note.size(), kMaxName));
      clean(note);
    }
  }
  const RawMesh& raw = answer.raw;
  if (raw.positions.size() % 3 != 0 || raw.normals.size() % 3 != 0 || raw.texcoords.size() % 2 != 0) return "sizes";
  const std::uint64_t positions = raw.position_count(), normals = raw.normals.size() / 3,
                      texcoords = raw.texcoords.size() / 2;
  // A corner has at most one normal and one pair of texture coordinates of its own.
  if (positions > max_vertices || normals > 3 * max_triangles || texcoords > 3 * max_triangles) return "sizes";
  if (raw.materials.size() > kMaxMaterials || raw.lines.size() > max_triangles) return "sizes";
  if (!finite(raw.positions) || !finite(raw.normals) || !finite(raw.texcoords)) return "numbers that are not finite";
  for (const RawCorner& c : raw.corners) {
    const bool good = c.position < positions && (c.normal == kNoIndex || c.normal < normals) &&
                      (c.texcoord == kNoIndex || c.texcoord < texcoords);
    if (!good) return "an index out of range";
  }
  const auto materials = static_cast<std::int64_t>(raw.materials.size());
  std::uint64_t triangles = 0;
  for (const RawFace& f : raw.faces) {
    if (f.count < 3 || std::uint64_t{f.first} + f.count > raw.corners.size()) return "an index out of range";
    if (f.material < -1 || f.material >= materials) return "an index out of range";
    triangles += f.count - 2;
  }
  if (triangles > max_triangles) return "sizes";
  for (const RawLine& l : raw.lines) {
    if (l.a >= positions || l.b >= positions || l.material < -1 || l.material >= materials)
      return "an index out of range";
  }
  for (Material& m : answer.raw.materials) {
    if (!clean_material(m, answer.pictures.size())) return "a material";
  }
  return {};
}

}  // namespace ambf::mesh
