#include "mesh/formats/detail/recognise.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

struct Kind {
  std::string_view ending;
  Format format;
  std::string_view name;
};

// Ours, then those that assimp reads and our tests try; docs/meshes.md lists them all.
constexpr Kind kKinds[] = {
    {"stl", Format::stl, "STL"},       {"obj", Format::obj, "OBJ"},         {"ply", Format::ply, "PLY"},
    {"3ds", Format::threeds, "3DS"},   {"dae", Format::collada, "COLLADA"}, {"gltf", Format::imported, "glTF"},
    {"glb", Format::imported, "glTF"}, {"fbx", Format::imported, "FBX"},    {"3mf", Format::imported, "3MF"},
    {"x3d", Format::imported, "X3D"},  {"off", Format::imported, "OFF"},    {"amf", Format::imported, "AMF"},
};

// assimp's further formats of triangles, untested here.
constexpr std::string_view kUntested[] = {
    "3d",   "ac",   "ac3d",     "acc",    "ase", "ask",     "assbin", "b3d",  "blend", "bsp", "cob",     "dxf",
    "enff", "hmp",  "ifc",      "ifczip", "iqm", "irrmesh", "lwo",    "lxo",  "md2",   "md3", "md5mesh", "mdc",
    "mdl",  "mesh", "mesh.xml", "ms3d",   "ndo", "nff",     "ogex",   "pk3",  "pmx",   "prj", "q3o",     "q3s",
    "sib",  "smd",  "step",     "stp",    "ter", "uc",      "x",      "x3db", "xgl",   "zae", "zgl"};

// Endings that assimp knows, too, but that name other things as often, or hold no surface.
constexpr Kind kRefused[] = {{"xml", Format::unknown, "an XML document of any kind"},
                             {"scn", Format::unknown, "a scene"},
                             {"raw", Format::unknown, "numbers without a fixed form"},
                             {"irr", Format::unknown, "a scene"},
                             {"lws", Format::unknown, "a scene"},
                             {"bvh", Format::unknown, "an animation"},
                             {"csm", Format::unknown, "an animation"},
                             {"mot", Format::unknown, "an animation"},
                             {"md5anim", Format::unknown, "an animation"},
                             {"md5camera", Format::unknown, "an animation"},
                             {"vta", Format::unknown, "an animation"}};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::string ending_of(const std::string& path) {
  const std::string name = lower_case(std::filesystem::path(path).filename().string());
  if (name.size() > 9 && name.compare(name.size() - 9, 9, ".mesh.xml") == 0) return "mesh.xml";
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos ? std::string() : name.substr(dot + 1);
}

std::uint64_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// What the content says for certain; empty otherwise (an OBJ has no mark, an ascii STL shares "solid" with names, a zip
// archive and JSON may be anything).
std::string ending_of_content(std::string_view bytes) {
  const std::string_view start = trim(bytes.substr(0, 1024));
  const auto holds = [start](std::string_view word) { return start.find(word) != std::string_view::npos; };
  if (bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 4) == "ply\r") return "ply";
  if (holds("<COLLADA")) return "dae";
  if (bytes.substr(0, 4) == "glTF") return "glb";
  if (bytes.substr(0, 18) == "Kaydara FBX Binary") return "fbx";
  if (start.substr(0, 1) == "<" && holds("<X3D")) return "x3d";
  if (start.substr(0, 1) == "<" && holds("<amf")) return "amf";
  if (bytes.size() >= 84 && bytes.size() == 84 + 50 * little_endian(bytes, 80)) return "stl";
  if (starts_with_ignoring_case(start, "solid") && holds("facet")) return "stl";
  if (bytes.size() >= 6 && bytes.substr(0, 2) == "MM" && little_endian(bytes, 2) == bytes.size()) return "3ds";
  return {};
}

const Kind* kind_of(std::string_view ending) {
  const auto found =
      std::find_if(std::begin(kKinds), std::end(kKinds), [&](const Kind& k) { return k.ending == ending; });
  return found == std::end(kKinds) ? nullptr : found;
}

}  // namespace

Recognised recognise(const std::string& path, std::string_view bytes) {
  const std::string named = ending_of(path), found = ending_of_content(bytes);
  Recognised result;
  result.ending = found.empty() ? named : found;
  const Kind* kind = kind_of(result.ending);
  if (kind != nullptr) {
    const Kind* of_name = kind_of(named);
    result.format = kind->format;
    result.name = kind->name;
    result.as_named = of_name != nullptr && of_name->name == kind->name;
    return result;
  }
  if (std::find(std::begin(kUntested), std::end(kUntested), result.ending) != std::end(kUntested)) {
    result.format = Format::imported;
    result.name = "." + result.ending;
  }
  for (const Kind& refused : kRefused) {
    if (refused.ending == result.ending) result.refused_as = refused.name;
  }
  return result;
}

}  // namespace ambf::mesh
