// Helpers of the mesh tests: temporary files, and meshes of every format made in memory.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesh/loader.h"

namespace ambf::mesh::test {

// An empty folder of the running test, removed at its end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "ambf_mesh_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

template <typename T>
void put(std::string& bytes, T value, bool big_endian = false) {
  std::string part(reinterpret_cast<const char*>(&value), sizeof value);
  bytes += big_endian ? std::string(part.rbegin(), part.rend()) : part;
}

inline std::string binary_stl(const std::vector<math::Vec3>& corners) {
  std::string bytes = "solid made by a test, binary in spite of its first word";
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(corners.size() / 3));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) bytes.append(12, '\0');
    put(bytes, static_cast<float>(corners[i].x));
    put(bytes, static_cast<float>(corners[i].y));
    put(bytes, static_cast<float>(corners[i].z));
    if (i % 3 == 2) bytes.append(2, '\0');
  }
  return bytes;
}

// Corners of the triangles of a mesh.
inline std::vector<math::Vec3> corners_of(const Mesh& mesh) {
  std::vector<math::Vec3> corners;
  for (const Submesh& s : mesh.submeshes) {
    for (std::uint32_t v : s.triangles) corners.push_back(s.vertex(v));
  }
  return corners;
}

inline std::string chunk(std::uint16_t id, const std::string& content) {
  std::string bytes;
  put(bytes, id);
  put(bytes, static_cast<std::uint32_t>(content.size() + 6));
  return bytes + content;
}

// The two triangles of a unit square as .3ds with a material.
inline std::string square_3ds(std::uint16_t last_index = 3) {
  std::string vertices, faces, texcoords, list("red\0", 4);
  put<std::uint16_t>(vertices, 4);
  put<std::uint16_t>(texcoords, 4);
  for (float xy : {0.0F, 1.0F, 2.0F, 3.0F}) {
    const float x = xy == 1.0F || xy == 2.0F ? 1.0F : 0.0F, y = xy >= 2.0F ? 1.0F : 0.0F;
    for (float value : {x, y, 0.5F}) put(vertices, value);
    for (float value : {x, y}) put(texcoords, value);
  }
  put<std::uint16_t>(faces, 2);
  for (int index : {0, 1, 2, 7, 0, 2, static_cast<int>(last_index), 7}) put(faces, static_cast<std::uint16_t>(index));
  put<std::uint16_t>(list, 2);
  put<std::uint16_t>(list, 0);
  put<std::uint16_t>(list, 1);
  const std::string color = chunk(0x0011, std::string("\xFF\x00\x00", 3));
  const std::string material = chunk(0xAFFF, chunk(0xA000, std::string("red\0", 4)) + chunk(0xA020, color));
  const std::string mesh =
      chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces + chunk(0x4130, list)) + chunk(0x4140, texcoords));
  return chunk(0x4D4D, chunk(0x3D3D, material + chunk(0x4000, std::string("square\0", 7) + mesh)));
}

// A unit cube of six quads as OBJ.
inline std::string cube_obj() {
  return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

// A square with a scene: a node turned by 90 degrees about x, moved and scaled, in centimetres.
inline std::string square_dae(const std::string& up = "Y_UP") {
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="centimeter" meter="0.01"/><up_axis>)" +
         up + R"(</up_axis></asset>
  <library_images><image id="img"><init_from>file:///C:/somewhere/wood%20dark.png</init_from></image></library_images>
  <library_effects><effect id="fx"><profile_COMMON>
    <newparam sid="surface"><surface type="2D"><init_from>img</init_from></surface></newparam>
    <newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>
    <technique sid="common"><phong><diffuse><texture texture="sampler" texcoord="UV"/></diffuse>
      <specular><color>0.25 0.5 0.75 1</color></specular><shininess><float>50</float></shininess></phong></technique>
  </profile_COMMON></effect></library_effects>
  <library_materials><material id="mat" name="wood"><instance_effect url="#fx"/></material></library_materials>
  <library_geometries><geometry id="square"><mesh>
    <source id="pos"><float_array id="pa" count="12">0 0 0 <!-- a comment --> 1 0 0 1 1 0 0 1 0</float_array>
      <technique_common><accessor source="#pa" count="4" stride="3"/></technique_common></source>
    <source id="nor"><float_array id="na" count="3">0 0 2</float_array>
      <technique_common><accessor source="#na" count="1" stride="3"/></technique_common></source>
    <source id="uv"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array>
      <technique_common><accessor source="#ua" count="4" stride="2"/></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#pos"/></vertices>
    <polylist material="symbol" count="1">
      <input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#nor" offset="1"/>
      <input semantic="TEXCOORD" source="#uv" offset="2" set="0"/>
      <vcount>4</vcount><p>0 0 0 1 0 1 2 0 2 3 0 3</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="scene"><node>
    <translate>100 0 0</translate><rotate>1 0 0 90</rotate><scale>2 2 2</scale>
    <instance_geometry url="#square"><bind_material><technique_common>
      <instance_material symbol="symbol" target="#mat"/></technique_common></bind_material></instance_geometry>
  </node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
)";
}

inline std::string square_ply_ascii() {
  return "ply\nformat ascii 1.0\ncomment made by a test\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nelement face 1\nproperty list uchar int vertex_indices\n"
         "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
         "0 0 0 255\n1 0 0 255\n1 1 0 255\n0 1 0 255\n4 0 1 2 3\n0 2\n";
}

inline std::string square_ply_binary(bool big_endian) {
  std::string bytes =
      "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
      "_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty float z\n"
      "property list uint8 int16 extra\nelement face 2\nproperty list uchar uint vertex_index\nend_header\n";
  for (int i = 0; i < 4; ++i) {
    put(bytes, i == 1 || i == 2 ? 1.0 : 0.0, big_endian);
    put(bytes, i >= 2 ? 1.0F : 0.0F, big_endian);
    put(bytes, 0.0F, big_endian);
    bytes += '\2';
    put<std::int16_t>(bytes, 5, big_endian);
    put<std::int16_t>(bytes, 6, big_endian);
  }
  for (const auto& face : {std::vector<std::uint32_t>{0, 1, 2}, std::vector<std::uint32_t>{0, 2, 3}}) {
    bytes += '\3';
    for (std::uint32_t index : face) put(bytes, index, big_endian);
  }
  return bytes;
}

// What every loaded mesh must be, whatever the file: sizes that fit, indices in range, finite numbers, unit normals.
inline void expect_sound(const Mesh& mesh) {
  for (const Submesh& s : mesh.submeshes) {
    const std::size_t n = s.vertex_count();
    ASSERT_EQ(s.positions.size() % 3, 0U);
    ASSERT_EQ(s.normals.size(), s.positions.size());
    ASSERT_TRUE(s.texcoords.empty() || s.texcoords.size() == 2 * n);
    ASSERT_TRUE(s.tangents.empty() || s.tangents.size() == 4 * n);
    ASSERT_EQ(s.triangles.size() % 3, 0U);
    ASSERT_LT(s.material, static_cast<int>(mesh.materials.size()));
    for (std::uint32_t index : s.triangles) ASSERT_LT(index, n);
    for (const auto& line : s.lines) {
      ASSERT_LT(line[0], n);
      ASSERT_LT(line[1], n);
    }
    for (const std::vector<float>* values : {&s.positions, &s.normals, &s.texcoords, &s.tangents}) {
      for (float value : *values) ASSERT_TRUE(std::isfinite(value));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const math::Vec3 normal{s.normals[3 * i], s.normals[3 * i + 1], s.normals[3 * i + 2]};
      ASSERT_NEAR(math::norm(normal), 1.0, 1e-4);
    }
  }
}

inline std::string text_of(const base::Diagnostics& diagnostics) {
  std::string all;
  for (const base::Diagnostic& d : diagnostics) all += to_string(d) + "\n";
  return all;
}

// The result is one error, and nothing else was made.
inline void expect_refused(const LoadResult& result) {
  EXPECT_FALSE(result.ok);
  EXPECT_TRUE(result.mesh.submeshes.empty());
  std::size_t errors = 0;
  for (const base::Diagnostic& d : result.diagnostics) {
    if (d.severity != base::Severity::error) continue;
    ++errors;
    EXPECT_FALSE(d.message.empty());
    EXPECT_FALSE(d.hint.empty()) << d.message;
  }
  EXPECT_EQ(errors, 1U) << text_of(result.diagnostics);
}

}  // namespace ambf::mesh::test
