// Private to mesh/ and ambf_file_reader: what the loader asks the worker process for a mesh file, and its answer. The
// answer comes from a process that has parsed a stranger's file: nothing in it is believed before check() has passed.
#pragma once

#include <string>
#include <vector>

#include "base/wire.h"
#include "mesh/formats/raw_mesh.h"

namespace ambf::mesh {

struct ReaderQuestion {
  std::string ending;  // without the dot, in lower case: chooses the importer
  std::uint64_t max_triangles = 0, max_vertices = 0;
  std::string bytes;  // of the file
};

struct ReaderAnswer {
  std::string error;  // empty: `raw` was read
  std::string importer;
  RawMesh raw;  // textures of its materials: names as written in the file, "*N" for pictures[N]
  std::vector<std::string> warnings, information;
  std::vector<std::string> pictures;  // the bytes of image files within the file
};

template <typename Wire, typename Question>
void transfer_question(Wire& wire, Question& q) {
  wire.text(q.ending);
  wire.value(q.max_triangles);
  wire.value(q.max_vertices);
  wire.text(q.bytes);
}

template <typename Wire>
void transfer_answer(Wire& wire, ReaderAnswer& a) {
  const auto text = [&wire](std::string& s) { wire.text(s); };
  wire.text(a.error);
  wire.text(a.importer);
  wire.values(a.raw.positions);
  wire.values(a.raw.texcoords);
  wire.values(a.raw.normals);
  wire.values(a.raw.corners);
  wire.values(a.raw.faces);
  wire.values(a.raw.lines);
  wire.list(a.raw.materials, [&wire](Material& m) {
    wire.text(m.name);
    for (Color* color : {&m.ambient, &m.diffuse, &m.specular, &m.emission}) wire.value(*color);
    wire.value(m.shininess);
    wire.value(m.metallic);
    wire.text(m.texture_file);
    wire.text(m.normal_map_file);
  });
  wire.list(a.warnings, text);
  wire.list(a.information, text);
  wire.list(a.pictures, text);
}

// Of an answer as it came: sizes, indices, finiteness, names. Empty, or what is wrong with it. Colours are cut to
// [0, 1].
std::string check(ReaderAnswer& answer, std::uint64_t max_triangles, std::uint64_t max_vertices);

}  // namespace ambf::mesh
