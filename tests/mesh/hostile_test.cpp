// Any bytes end in a sound mesh or in exactly one error: seeds of every format cut short at each place, and with
// bytes changed at random. (tests/fuzz explores further; this keeps the guard in every build.)
#include <random>

#include "tests/mesh/files.h"

namespace ambf::mesh {
namespace {

using namespace test;  // NOLINT

void expect_sound_or_refused(const std::string& bytes, const std::string& name) {
  LoadOptions options;
  options.max_triangles = 10000;
  options.max_vertices = 30000;
  options.second_reader = false;  // a process for each of thousands of files
  const LoadResult r = load_bytes(bytes, name, options);
  r.ok ? expect_sound(r.mesh) : expect_refused(r);
}

class HostileInput : public testing::TestWithParam<int> {
 protected:
  std::pair<std::string, std::string> seed() const {
    switch (GetParam()) {
      case 0: return {binary_stl({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}), "a.stl"};
      case 1:
        return {
            "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
            "0\nendloop\nendfacet\nendsolid x\n",
            "a.stl"};
      case 2: return {"mtllib a.mtl\n" + cube_obj() + "s 1\nusemtl m\nl 1 2 3\nf -1//1 -2 -3/1/1\n", "a.obj"};
      case 3: return {square_ply_ascii(), "a.ply"};
      case 4: return {square_ply_binary(true), "a.ply"};
      case 5: return {square_3ds(), "a.3ds"};
      default: return {square_dae(), "a.dae"};
    }
  }
};

TEST_P(HostileInput, CutShortAnywhere) {
  const auto [bytes, name] = seed();
  for (std::size_t length = 0; length < bytes.size(); ++length) expect_sound_or_refused(bytes.substr(0, length), name);
}

TEST_P(HostileInput, BytesChangedAtRandom) {
  const auto [bytes, name] = seed();
  std::mt19937 rng(static_cast<unsigned>(GetParam()));
  const std::string pieces[] = {
      "-1", "99999999999", "1e38", "nan", "/", "<", ">", "\"", "#", "\n", std::string(1, '\0'), "\xFF\xFF\xFF\xFF"};
  for (int round = 0; round < 3000; ++round) {
    std::string changed = bytes;
    for (unsigned k = 0, n = 1 + rng() % 4; k < n; ++k) {
      const std::size_t at = rng() % changed.size();
      switch (rng() % 4) {
        case 0: changed[at] = static_cast<char>(rng()); break;
        case 1: changed[at] = static_cast<char>(changed[at] ^ (1 << (rng() % 8))); break;
        case 2: changed.replace(at, rng() % 4, pieces[rng() % std::size(pieces)]); break;
        default: changed.insert(at, changed.substr(rng() % changed.size(), rng() % 40)); break;
      }
    }
    expect_sound_or_refused(changed, name);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
}

const char* const kSeeds[] = {"stl", "stl_text", "obj", "ply_text", "ply", "a_3ds", "dae"};  // as in seed()
INSTANTIATE_TEST_SUITE_P(Formats, HostileInput, testing::Range(0, 7),
                         [](const auto& parameter) { return std::string(kSeeds[parameter.param]); });

TEST(HostileInput, HugeCountsCostNothing) {
  expect_refused(
      load_bytes("ply\nformat binary_little_endian 1.0\nelement vertex 1999999\nproperty double x\nproperty "
                 "double y\nproperty double z\nend_header\n",
                 "a.ply"));
  expect_refused(load_bytes("ply\nformat ascii 1.0\nelement nothing 9223372036854775807\nend_header\n", "a.ply"));
  std::string stl(84, '\0');
  stl.replace(80, 4, "\xFF\xFF\xFF\xFF");
  expect_refused(load_bytes(stl, "a.stl"));
}

// Entities that would expand to gigabytes, or to another file: neither happens, and the rest is read.
TEST(HostileInput, ColladaEntitiesAreNotExpanded) {
  std::string doctype = "<!DOCTYPE COLLADA [<!ENTITY a0 \"lol\"><!ENTITY secret SYSTEM \"file:///etc/passwd\">";
  for (int i = 1; i < 30; ++i) {
    doctype += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) doctype += "&a" + std::to_string(i - 1) + ";";
    doctype += "\">";
  }
  std::string dae = square_dae("Z_UP");
  dae.insert(dae.find("<COLLADA"), doctype + "]>");
  dae.replace(dae.find("name=\"wood\""), 11, "name=\"&a29;&secret;\"");
  const auto r = load_bytes(dae, "a.dae");
  ASSERT_TRUE(r.ok) << text_of(r.diagnostics);
  ASSERT_EQ(r.mesh.materials.size(), 1U);
  EXPECT_EQ(r.mesh.materials[0].name, "&a29;&secret;");
  dae.replace(dae.find("<unit"), 0, "&a29;");
  EXPECT_TRUE(load_bytes(dae, "a.dae").ok);
  dae.replace(dae.find("0 0 0 <!--"), 5, "&a29;");
  expect_refused(load_bytes(dae, "a.dae"));
}

// As deep as a file can be: neither the parser nor what walks its tree recurses.
TEST(HostileInput, DeeplyNestedColladaIsHarmless) {
  constexpr int kDepth = 400'000;
  std::string opening, closing;
  for (int i = 0; i < kDepth; ++i) {
    opening += "<node>";
    closing += "</node>";
  }
  std::string dae = square_dae();
  dae.insert(dae.find("<translate>"), opening + closing);
  expect_refused(load_bytes(dae, "a.dae"));  // by the depth of its scene
  dae = square_dae("Z_UP");
  dae.insert(dae.find("<library_images>"), "<extra>" + opening + closing + "</extra>");
  EXPECT_TRUE(load_bytes(dae, "a.dae").ok);
}

TEST(HostileInput, ColladaOfTooManyElementsIsRefusedBeforeItIsParsed) {
  std::string many(8'000'000, ' ');
  for (std::size_t i = 0; i < many.size(); i += 4) many.replace(i, 4, "<a/>");
  std::string dae = square_dae();
  dae.insert(dae.find("<library_images>"), many);
  const auto r = load_bytes(dae, "a.dae");
  expect_refused(r);
  EXPECT_NE(r.diagnostics[0].message.find("2000000"), std::string::npos) << r.diagnostics[0].message;
}

TEST(HostileInput, ExponentialColladaInstancesAreRefused) {
  std::string nodes = "<node id=\"n0\"><instance_geometry url=\"#square\"/></node>";
  for (int i = 1; i < 60; ++i) {
    const std::string below = "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
    nodes += "<node id=\"n" + std::to_string(i) + "\">" + below + below + "</node>";
  }
  std::string dae = square_dae();
  dae.replace(dae.find("<library_visual_scenes>"), 0, "<library_nodes>" + nodes + "</library_nodes>");
  dae.replace(dae.find("<translate>"), 0, "<instance_node url=\"#n59\"/>");
  expect_refused(load_bytes(dae, "a.dae"));
}

TEST(HostileInput, ManyTrianglesAroundOneVertexStayLinear) {
  // The tip of a cone of 60000 triangles: comparing each with each would be 3.6e9 pairs.
  std::string obj = "v 0 0 1\n";
  const int n = 60000;
  for (int i = 0; i < n; ++i) {
    const double a = 6.283185307179586 * i / n;
    obj += "v " + std::to_string(100.0 * std::cos(a)) + " " + std::to_string(100.0 * std::sin(a)) + " 0\n";
  }
  for (int i = 0; i < n; ++i) obj += "f 1 " + std::to_string(i + 2) + " " + std::to_string((i + 1) % n + 2) + "\n";
  const auto begin = std::clock();
  const LoadResult r = load_bytes(obj, "cone.obj");
  ASSERT_TRUE(r.ok);
  expect_sound(r.mesh);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC,
            5.0);  // the promise, some hundred times the need
}

}  // namespace
}  // namespace ambf::mesh
