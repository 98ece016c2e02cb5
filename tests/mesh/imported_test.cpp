// Formats that assimp reads in its own process: coordinates, winding, units, colours, textures; and what becomes of a
// file when that process dies of it.
#include "tests/mesh/imported_files.h"

#include <dirent.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesh/cache.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/reader_answer.h"

namespace ambf::mesh {
namespace {

using namespace test;  // NOLINT

// Oriented triangles in an order that does not depend on where each begins.
std::vector<std::array<std::array<double, 3>, 3>> triangles_of(const std::vector<math::Vec3>& corners) {
  std::vector<std::array<std::array<double, 3>, 3>> all;
  const auto rounded = [](const math::Vec3& v) {
    const auto part = [](double d) { return std::round(d * 1e6) + 0.0; };
    return std::array<double, 3>{part(v.x), part(v.y), part(v.z)};
  };
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    std::array<std::array<double, 3>, 3> t{rounded(corners[i]), rounded(corners[i + 1]), rounded(corners[i + 2])};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    all.push_back(t);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::string messages(const base::Diagnostics& diagnostics) {
  std::string text;
  for (const base::Diagnostic& d : diagnostics) text += d.message + "\n";
  return text;
}

// The material of all of its triangles.
Material only_material(const Mesh& mesh) {
  EXPECT_EQ(mesh.submeshes.size(), 1U);
  const int index = mesh.submeshes.empty() ? -1 : mesh.submeshes[0].material;
  EXPECT_GE(index, 0);
  return index < 0 ? Material{} : mesh.materials[static_cast<std::size_t>(index)];
}

void expect_color(const Color& color, float r, float g, float b) {
  EXPECT_NEAR(color.r, r, 0.003);
  EXPECT_NEAR(color.g, g, 0.003);
  EXPECT_NEAR(color.b, b, 0.003);
}

class Imported : public testing::Test {
 protected:
  Mesh wedge_in(const std::string& name, const std::string& bytes) {
    LoadResult result = load(folder_.write(name, bytes));
    EXPECT_TRUE(result.ok) << messages(result.diagnostics);
    EXPECT_EQ(result.format, Format::imported);
    EXPECT_EQ(triangles_of(corners_of(result.mesh)), triangles_of(wedge()));
    depends_on_ = result.depends_on;
    diagnostics_ = result.diagnostics;
    return std::move(result.mesh);
  }
  bool depends_on(const std::string& name) const {
    return std::find(depends_on_.begin(), depends_on_.end(), folder_ / name) != depends_on_.end();
  }

  Folder folder_;
  std::vector<std::string> depends_on_;
  base::Diagnostics diagnostics_;
};

TEST_F(Imported, Off) { wedge_in("wedge.off", off_wedge()); }

TEST_F(Imported, AmfInItsUnitAndColour) {
  expect_color(only_material(wedge_in("wedge.amf", amf_wedge())).diffuse, 0.2F, 0.4F, 0.6F);
}

TEST_F(Imported, X3dPlacedByItsNodesWithATextureBesideIt) {
  const std::string wood = folder_.write("wood.png", from_base64(kPicture64));
  const Mesh mesh = wedge_in("wedge.x3d", x3d_wedge());
  EXPECT_EQ(only_material(mesh).texture_file, wood);
}

TEST_F(Imported, ThreemfInItsUnitAndColour) {
  expect_color(only_material(wedge_in("wedge.3mf", threemf_wedge())).diffuse, 0.2F, 0.4F, 0.6F);
}

TEST_F(Imported, FbxInCentimetresMirroredWithThePictureWithinIt) {
  const Mesh mesh = wedge_in("wedge.fbx", fbx_wedge());
  const Material material = only_material(mesh);
  EXPECT_NEAR(material.diffuse.a, 0.5, 1e-6);
  ASSERT_EQ(mesh.pictures.count(material.texture_file), 1U) << material.texture_file;
  EXPECT_EQ(*mesh.pictures.at(material.texture_file), from_base64(kPicture64));
  ASSERT_FALSE(mesh.submeshes[0].texcoords.empty());
}

TEST_F(Imported, GltfMirroredWithBufferAndPicturesBesideIt) {
  folder_.write("wedge data.bin", gltf_buffer());
  const std::string wood = folder_.write("wood.png", from_base64(kPicture64));
  const std::string bumps = folder_.write("bumps.png", from_base64(kPicture64));
  const Mesh mesh = wedge_in("wedge.gltf", gltf_wedge());
  const Material material = only_material(mesh);
  EXPECT_EQ(material.texture_file, wood);
  EXPECT_EQ(material.normal_map_file, bumps);
  expect_color(material.diffuse, 1.0F, 0.7354F, 0.5371F);  // sRGB of the linear 1, 0.5, 0.25
  EXPECT_NEAR(material.diffuse.a, 0.5, 1e-6);
  EXPECT_NEAR(material.metallic, 0.75, 1e-6);
  EXPECT_NEAR(material.shininess, 30.0, 1e-3);  // 2 / 0.5^4 - 2
  EXPECT_TRUE(depends_on("wedge data.bin"));
  EXPECT_TRUE(depends_on("wood.png"));
  ASSERT_EQ(mesh.submeshes.size(), 1U);
  const Submesh& part = mesh.submeshes[0];
  ASSERT_FALSE(part.texcoords.empty());
  for (std::size_t i = 0; i < part.vertex_count(); ++i) {  // v upwards: glTF's 0 is the picture's upper edge
    EXPECT_FLOAT_EQ(part.texcoords[2 * i], part.positions[3 * i] + part.positions[3 * i + 2] > 0.005F ? 1.0F : 0.0F);
    EXPECT_FLOAT_EQ(part.texcoords[2 * i + 1],
                    part.positions[3 * i + 1] + part.positions[3 * i + 2] > 0.005F ? 1.0F : 0.0F);
  }
}

TEST_F(Imported, GlbWithThePictureWithinIt) {
  const Mesh mesh = wedge_in("wedge.glb", glb_wedge());
  const Material material = only_material(mesh);
  ASSERT_EQ(mesh.pictures.count(material.texture_file), 1U) << material.texture_file;
  EXPECT_EQ(*mesh.pictures.at(material.texture_file), from_base64(kPicture64));
  EXPECT_NE(messages(diagnostics_).find("bumps.png"), std::string::npos) << "a normal map that is not there";
}

TEST_F(Imported, TheContentDecidesOverTheEnding) {
  const Mesh mesh = wedge_in("wedge.obj", glb_wedge());
  EXPECT_NE(messages(diagnostics_).find("glTF by its content"), std::string::npos);
}

TEST_F(Imported, TheCacheReadsAgainWhenABufferChanged) {
  folder_.write("wedge data.bin", gltf_buffer());
  const std::string path = folder_.write("wedge.gltf", gltf_wedge());
  MeshCache cache;
  const CachedMesh first = cache.load(path);
  ASSERT_NE(first.mesh, nullptr);
  EXPECT_EQ(cache.load(path).mesh, first.mesh);
  std::string larger = gltf_buffer();
  const float tip = 0.05F;
  larger.replace(44, 4, reinterpret_cast<const char*>(&tip), 4);
  folder_.write("wedge data.bin", larger);
  const CachedMesh second = cache.load(path);
  ASSERT_NE(second.mesh, nullptr);
  EXPECT_NEAR(second.mesh->bounds.max.z, 0.05, 1e-6);
}

TEST_F(Imported, EndingsOfScenesAndAnimationsAreRefused) {
  for (const char* name : {"a.scn", "a.bvh", "a.raw", "a.xml"}) {
    const LoadResult result = load(folder_.write(name, "HIERARCHY\nROOT a\n"));
    EXPECT_FALSE(result.ok);
    EXPECT_NE(messages(result.diagnostics).find("not read as meshes"), std::string::npos) << name;
  }
}

TEST_F(Imported, WhatOurReaderDoesNotUnderstandIsTriedThere) {
  const std::string text =
      "solid x\ncolor 1 0 0\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid x\n";
  LoadOptions alone;
  alone.second_reader = false;
  const LoadResult refused = load_bytes(text, "painted.stl", alone);
  ASSERT_FALSE(refused.ok);
  const LoadResult result = load_bytes(text, "painted.stl");
  ASSERT_TRUE(result.ok) << messages(result.diagnostics);
  EXPECT_EQ(result.mesh.triangle_count(), 1U);
  EXPECT_NE(messages(result.diagnostics).find(refused.diagnostics.back().message), std::string::npos);
  EXPECT_NE(messages(result.diagnostics).find("assimp"), std::string::npos);
}

TEST_F(Imported, WhatNeitherReaderUnderstandsIsOneErrorWithBothReasons) {
  const LoadResult result = load_bytes("ply\nformat curly 1.0\nend_header\n", "broken.ply");
  ASSERT_FALSE(result.ok);
  expect_refused(result);
  EXPECT_NE(result.diagnostics.back().hint.find("second reader"), std::string::npos);
}

// Stands in for the worker: a shell script.
class Worker : public Imported {
 protected:
  LoadResult load_with(const std::string& script, const std::string& name = "wedge.off") {
    LoadOptions options;
    options.worker_program = folder_.write("reader", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(options.worker_program, std::filesystem::perms::owner_all);
    options.worker_silence_s = 0.3;
    return load(folder_.write(name, name == "cube.obj" ? cube_obj() : off_wedge()), options);
  }
  void expect_one_error(const std::string& script, const std::string& cause) {
    const LoadResult result = load_with(script);
    expect_refused(result);
    EXPECT_NE(messages(result.diagnostics).find(cause), std::string::npos)
        << script << ": " << messages(result.diagnostics);
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a process is left";
  }
};

std::size_t open_descriptors() {
  std::size_t count = 0;
  DIR* folder = ::opendir("/proc/self/fd");
  while (::readdir(folder) != nullptr) ++count;
  ::closedir(folder);
  return count;
}

TEST_F(Worker, FaultsAreOneErrorEachThatNamesTheCause) {
  const std::size_t before = open_descriptors();
  expect_one_error("kill -KILL $$", "Killed");
  expect_one_error("kill -SEGV $$", "Segmentation fault");
  expect_one_error("kill -STOP $$", "did not answer within 0.3 s");
  expect_one_error("while :; do :; done", "did not answer within 0.3 s");
  expect_one_error("exec sleep 1000", "did not answer within 0.3 s");
  expect_one_error("exec <&- >&-; exec sleep 1000", "closed its connection");
  expect_one_error("exit 80", "more memory");
  expect_one_error("exit 3", "exit status 3");
  expect_one_error("exec cat /dev/zero", "malformed");
  expect_one_error("head -c 100 /dev/urandom", "malformed");
  expect_one_error("exec cat", "malformed");  // our own question
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_TRUE(load(folder_ / "wedge.off").ok) << "the next file loads";
}

TEST_F(Worker, RoundsLeaveNoProcessAndNoDescriptor) {
  const std::size_t before = open_descriptors();
  for (int round = 0; round < 50; ++round) EXPECT_FALSE(load_with("kill -KILL $$").ok);
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
}

TEST_F(Worker, IsNotStartedForWhatOurReadersRead) {
  const std::string mark = folder_ / "started";
  EXPECT_TRUE(load_with("touch '" + mark + "'", "cube.obj").ok);
  EXPECT_FALSE(std::filesystem::exists(mark));
  EXPECT_FALSE(load_with("touch '" + mark + "'").ok);
  EXPECT_TRUE(std::filesystem::exists(mark));
}

TEST_F(Worker, AMissingProgramIsOneError) {
  LoadOptions options;
  options.worker_program = "/no/such/reader";
  const LoadResult result = load_bytes(off_wedge(), "wedge.off", options);
  expect_refused(result);
  EXPECT_NE(messages(result.diagnostics).find("/no/such/reader"), std::string::npos);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__clang__)
// Sanitized workers have no limit of memory (CI's builds by clang are sanitized).
#else
TEST_F(Imported, AFileThatAsksForGigabytesIsOneErrorAboutMemory) {
  const LoadResult result = load(folder_.write("huge.off", "OFF\n700000000 1 0\n0 0 0\n3 0 0 0\n"));
  expect_refused(result);
  EXPECT_NE(messages(result.diagnostics).find("memory"), std::string::npos) << messages(result.diagnostics);
}
#endif

std::string answer_bytes() {
  ReaderAnswer answer;
  answer.raw.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  answer.raw.normals = {0, 0, 1};
  answer.raw.corners = {{0, kNoIndex, 0}, {1, kNoIndex, 0}, {2, kNoIndex, 0}};
  answer.raw.faces = {{0, 3, 0, kSmoothByAngle}};
  answer.raw.lines = {{0, 1, -1}};
  Material material;
  material.texture_file = "*0";
  answer.raw.materials = {material};
  answer.warnings = {"a warning"};
  answer.pictures = {"picture"};
  base::WireWriter writer;
  transfer_answer(writer, answer);
  return std::move(writer).bytes();
}

bool believed(const std::string& bytes) {
  ReaderAnswer answer;
  base::WireReader reader(bytes);
  transfer_answer(reader, answer);
  if (!reader.at_end() || !check(answer, 100, 100).empty()) return false;
  // What is believed can be built without harm.
  LoadResult result;
  const LoadOptions options;
  ReadContext context("a.off", options, result);
  if (build_mesh(std::move(answer.raw), context, result.mesh)) expect_sound(result.mesh);
  return true;
}

TEST(ReaderAnswer, IsNotBelievedWhenCutAtAnyByte) {
  const std::string whole = answer_bytes();
  EXPECT_TRUE(believed(whole));
  for (std::size_t length = 0; length < whole.size(); ++length) EXPECT_FALSE(believed(whole.substr(0, length)));
  EXPECT_FALSE(believed(whole + "x"));
}

TEST(ReaderAnswer, WithBytesChangedAtRandomIsSoundOrRefused) {
  std::mt19937 rng(7);
  for (int round = 0; round < 20000; ++round) {
    std::string changed = answer_bytes();
    for (unsigned k = 0, n = 1 + rng() % 4; k < n; ++k) changed[rng() % changed.size()] = static_cast<char>(rng());
    believed(changed);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
}

}  // namespace
}  // namespace ambf::mesh
