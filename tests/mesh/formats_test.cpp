// Each format gives the mesh that it describes.
#include <algorithm>
#include <cmath>

#include "mesh/mass_properties.h"
#include "mesh/weld.h"
#include "tests/mesh/files.h"

namespace ambf::mesh {
namespace {

using namespace test;  // NOLINT

void expect_unit_square(const LoadResult& r, double z = 0.0) {
  ASSERT_TRUE(r.ok) << text_of(r.diagnostics);
  expect_sound(r.mesh);
  EXPECT_EQ(r.mesh.triangle_count(), 2U);
  const MassProperties mass = mass_properties(make_collision_mesh(r.mesh));
  EXPECT_NEAR(mass.area, 1.0, 1e-6);
  EXPECT_NEAR(math::norm(mass.centre - math::Vec3{0.5, 0.5, z}), 0.0, 1e-6);
  for (std::size_t i = 0; i < r.mesh.submeshes[0].vertex_count(); ++i) {
    EXPECT_FLOAT_EQ(r.mesh.submeshes[0].normals[3 * i + 2], 1.0F);  // counter-clockwise seen from +z
  }
}

TEST(Stl, BinaryIsReadEvenWhenItsHeaderSaysSolid) {
  const auto r = load_bytes(binary_stl({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}), "a.STL");
  expect_unit_square(r);
  EXPECT_EQ(r.format, Format::stl);
  EXPECT_EQ(r.mesh.vertex_count(), 4U);  // the diagonal's vertices are joined
}

TEST(Stl, AsciiIsReadInAnyLetterCaseAndLocaleFree) {
  const auto r = load_bytes(
      "solid two words facet\nFACET NORMAL 0 0 0\n outer loop\nvertex 0 0 0\nvertex 1e0 0 0\nvertex +1 1.0 0\nendloop\n"
      "endfacet facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 1 0 vertex 0 1 1e-400 endloop endfacet\nendsolid\n",
      "a.stl");
  expect_unit_square(r);
}

TEST(Stl, TruncatedFileSaysWhatWasExpectedAndFound) {
  std::string bytes = binary_stl({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  bytes.resize(bytes.size() - 10);
  const auto r = load_bytes(bytes, "folder/part.stl");
  expect_refused(r);
  EXPECT_EQ(r.diagnostics[0].file, "folder/part.stl");
  EXPECT_NE(r.diagnostics[0].message.find("announces 2 triangles (184 bytes), found 174"), std::string::npos)
      << r.diagnostics[0].message;
}

TEST(Stl, NonFiniteCoordinateIsRefused) {
  expect_refused(load_bytes(binary_stl({{0, 0, 0}, {1, 0, 0}, {1, std::nan(""), 0}}), "a.stl"));
  expect_refused(
      load_bytes("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\nvertex 1 0 0\nvertex 0 1 0\n"
                 "endloop\nendfacet\nendsolid\n",
                 "a.stl"));
}

TEST(Stl, TrianglesWithoutAreaAreLeftOutAndCounted) {
  const auto r = load_bytes(binary_stl({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 2, 2}, {2, 2, 2}, {0, 1, 0}}), "a.stl");
  ASSERT_TRUE(r.ok);
  EXPECT_EQ(r.mesh.triangle_count(), 1U);
  EXPECT_NE(text_of(r.diagnostics).find("1 triangles without area"), std::string::npos);
}

TEST(Obj, MetalsAreThoseThatSayItOrThatMirror) {
  const Folder folder;
  folder.write("m.mtl",
               "newmtl plastic\nKs 1 1 1\nNs 200\nillum 2\nnewmtl half\nPm 0.5\nillum 3\n"
               "newmtl mirrors\nillum 3\nnewmtl painted\nillum 3\nPm 0\n");
  const std::string path = folder.write("a.obj",
                                        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl plastic\nf 1 2 3\n"
                                        "usemtl half\nf 1 2 3\nusemtl mirrors\nf 1 2 3\nusemtl painted\nf 1 2 3\n");
  const auto r = load(path);
  ASSERT_TRUE(r.ok) << text_of(r.diagnostics);
  ASSERT_EQ(r.mesh.materials.size(), 4U);
  const float expected[] = {0.0F, 0.5F, 1.0F, 0.0F};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(r.mesh.materials[i].metallic, expected[i]) << r.mesh.materials[i].name;
}

TEST(Obj, QuadsNegativeIndicesAndTexcoordsAreRead) {
  const auto r = load_bytes(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 5\n"
      "f -4/1/1 -3/2/1 -2/3/1 -1/4/1 # square\n",
      "a.OBJ");
  expect_unit_square(r);
  const Submesh& s = r.mesh.submeshes[0];
  ASSERT_EQ(s.texcoords.size(), 8U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(s.texcoords[2 * i], s.positions[3 * i]);
}

TEST(Obj, ConcavePolygonIsSplitInside) {
  // An arrow head: a fan from the first corner would cover area outside of it.
  const auto r = load_bytes("v 0 0 0\nv 2 -2 0\nv 0 2 0\nv -2 -2 0\nf 4 1 2 3\n", "a.obj");
  ASSERT_TRUE(r.ok);
  const MassProperties mass = mass_properties(make_collision_mesh(r.mesh));
  EXPECT_NEAR(mass.area, 4.0, 1e-6);
  for (std::size_t i = 0; i < r.mesh.vertex_count(); ++i) EXPECT_FLOAT_EQ(r.mesh.submeshes[0].normals[3 * i + 2], 1.0F);
}

TEST(Obj, PolylinesAreKeptWithoutTriangles) {
  const auto r = load_bytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\nl 3/1 2/1\nvt 0 0\n", "rope.obj");
  // The texture coordinate is given after its use: that is an index outside what stands before.
  expect_refused(r);
  EXPECT_EQ(r.diagnostics[0].line, 5);
  const auto good = load_bytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\nl 3 2\n", "rope.obj");
  ASSERT_TRUE(good.ok);
  EXPECT_EQ(good.mesh.submeshes.at(0).lines.size(), 3U);
  EXPECT_EQ(make_collision_mesh(good.mesh).lines.size(), 2U);  // the repeated one is dropped
}

TEST(Obj, MaterialsComeFromTheLibraryWithTexturesBesideIt) {
  const Folder folder;
  folder.write("wood dark.png", "x");
  folder.write("bumps.png", "x");
  folder.write(
      "my lib.mtl",
      "newmtl red\nKd 1 0.5 0\nKs 0.25 0.25 0.25\nNs 30\nd 0.5\nmap_Kd -s 1 1 1 -o 0 0 /home/else/wood dark.png\n"
      "map_Bump -bm 0.5 Bumps.PNG\nnewmtl gone\nmap_Kd nowhere.png\n");
  const std::string path = folder.write(
      "a.obj",
      "mtllib my lib.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\nusemtl "
      "gone\nf 1 3 2\nusemtl never\nf 1 2 3\n");
  const auto r = load(path);
  ASSERT_TRUE(r.ok) << text_of(r.diagnostics);
  expect_sound(r.mesh);
  ASSERT_EQ(r.mesh.submeshes.size(), 3U);
  ASSERT_EQ(r.mesh.materials.size(), 2U);
  const Material& red = r.mesh.materials[0];
  EXPECT_EQ(red.texture_file, folder / "wood dark.png");
  EXPECT_EQ(red.normal_map_file, folder / "bumps.png");  // letter case of another file system
  EXPECT_FLOAT_EQ(red.diffuse.g, 0.5F);
  EXPECT_FLOAT_EQ(red.diffuse.a, 0.5F);
  EXPECT_FLOAT_EQ(red.shininess, 30.0F);
  // Tangents along growing u, only where a normal map is.
  ASSERT_EQ(r.mesh.submeshes[0].tangents.size(), 12U);
  EXPECT_FLOAT_EQ(r.mesh.submeshes[0].tangents[0], 1.0F);
  EXPECT_FLOAT_EQ(r.mesh.submeshes[0].tangents[3], 1.0F);
  EXPECT_TRUE(r.mesh.submeshes[1].tangents.empty());
  EXPECT_EQ(r.mesh.submeshes[2].material, -1);
  // One warning for the missing texture and one for the missing material, both with a place.
  const std::string text = text_of(r.diagnostics);
  EXPECT_NE(text.find("my lib.mtl:9: warning: texture 'nowhere.png' was not found"), std::string::npos) << text;
  EXPECT_NE(text.find("a.obj:12: warning: material 'never' is not defined"), std::string::npos) << text;
  EXPECT_EQ(r.diagnostics.size(), 2U);
}

TEST(Obj, MissingLibraryIsOneWarning) {
  const Folder folder;
  const auto r = load(folder.write("a.obj", "mtllib none.mtl\nmtllib none.mtl\n" + cube_obj()));
  ASSERT_TRUE(r.ok);
  ASSERT_EQ(r.diagnostics.size(), 1U);
  EXPECT_EQ(r.diagnostics[0].severity, base::Severity::warning);
}

TEST(Obj, BadIndexNamesTheLine) {
  const auto r = load_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n", "a.obj");
  expect_refused(r);
  EXPECT_EQ(to_string(r.diagnostics[0]).substr(0, 15), "a.obj:5: error:");
  expect_refused(load_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "a.obj"));
  expect_refused(load_bytes("v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", "a.obj"));
  expect_refused(load_bytes("v 0 0 0\nv 1 0 0\nf 1 2\n", "a.obj"));
}

TEST(Ply, AsciiAndBothByteOrdersGiveTheSameSquare) {
  const auto ascii = load_bytes(square_ply_ascii(), "a.ply");
  expect_unit_square(ascii);
  EXPECT_EQ(ascii.mesh.submeshes.at(0).lines.size(), 1U);
  expect_unit_square(load_bytes(square_ply_binary(false), "a.ply"));
  expect_unit_square(load_bytes(square_ply_binary(true), "a.ply"));
}

TEST(Ply, WrongIndexAndShortFileAreRefused) {
  std::string bad = square_ply_ascii();
  bad.replace(bad.find("4 0 1 2 3"), 9, "4 0 1 2 4");
  expect_refused(load_bytes(bad, "a.ply"));
  std::string cut = square_ply_binary(false);
  cut.resize(cut.size() - 3);
  expect_refused(load_bytes(cut, "a.ply"));
}

TEST(ThreeDs, VerticesFacesAndMaterialsAreReadInFileAxes) {
  const auto r = load_bytes(square_3ds(), "a.3DS");
  expect_unit_square(r, 0.5);
  ASSERT_EQ(r.mesh.materials.size(), 1U);
  EXPECT_EQ(r.mesh.submeshes[0].material, 0);
  EXPECT_FLOAT_EQ(r.mesh.materials[0].diffuse.r, 1.0F);
  EXPECT_EQ(r.mesh.submeshes[0].texcoords.size(), 8U);
}

TEST(ThreeDs, IndexOutsideItsObjectIsRefused) { expect_refused(load_bytes(square_3ds(4), "a.3ds")); }

TEST(Collada, TransformsAndUnitAreAppliedButNotTheUpAxis) {
  const Folder folder;
  folder.write("wood dark.png", "x");
  const auto r = load(folder.write("a.dae", square_dae()));
  ASSERT_TRUE(r.ok) << text_of(r.diagnostics);
  expect_sound(r.mesh);
  // Scaled by 2, turned about x (y becomes z), moved by 100; all in centimetres.
  EXPECT_NEAR(math::norm(r.mesh.bounds.min - math::Vec3{1.0, 0.0, 0.0}), 0.0, 1e-6);
  EXPECT_NEAR(math::norm(r.mesh.bounds.max - math::Vec3{1.02, 0.0, 0.02}), 0.0, 1e-6);
  EXPECT_NEAR(r.mesh.submeshes[0].normals[1], -1.0, 1e-6);
  ASSERT_EQ(r.mesh.materials.size(), 1U);
  EXPECT_EQ(r.mesh.materials[0].texture_file, folder / "wood dark.png");
  EXPECT_FLOAT_EQ(r.mesh.materials[0].specular.b, 0.75F);
  EXPECT_NE(text_of(r.diagnostics).find("up_axis is 'Y_UP'"), std::string::npos);
  EXPECT_TRUE(load_bytes(square_dae("Z_UP"), folder / "b.dae").diagnostics.empty());
}

TEST(Collada, MirroredNodeKeepsFacesOutward) {
  std::string dae = square_dae("Z_UP");
  dae.replace(dae.find("<scale>2 2 2"), 12, "<scale>-2 2 2");
  const auto r = load_bytes(dae, "a.dae");
  ASSERT_TRUE(r.ok) << text_of(r.diagnostics);
  const Submesh& s = r.mesh.submeshes[0];
  const math::Vec3 a = s.vertex(s.triangles[0]), b = s.vertex(s.triangles[1]), c = s.vertex(s.triangles[2]);
  // The mirror image still faces -y, by its corners and by its normals.
  EXPECT_LT(math::cross(b - a, c - a).y, 0.0);
  EXPECT_NEAR(s.normals[1], -1.0, 1e-6);
}

TEST(Collada, NamespacePrefixesAreIgnored) {
  std::string dae = square_dae("Z_UP");
  for (const std::string name : {"COLLADA", "mesh", "float_array", "phong", "p"}) {
    for (const std::string& tag : {"<" + name + " ", "<" + name + ">", "</" + name + ">"}) {
      for (std::size_t at = dae.find(tag); at != std::string::npos; at = dae.find(tag, at + 1)) {
        dae.insert(dae.find(name, at), "c:");
      }
    }
  }
  ASSERT_NE(dae.find("<c:p>"), std::string::npos);
  const auto r = load_bytes(dae, "a.dae");
  ASSERT_TRUE(r.ok) << text_of(r.diagnostics);
  EXPECT_EQ(r.mesh.triangle_count(), 2U);
}

// What is wrong is said with its line, whether the XML or what it means.
TEST(Collada, MistakesAreReportedWithTheirLine) {
  const std::string good = square_dae("Z_UP");
  const auto line_of = [](const std::string& text, std::size_t at) {
    return static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
  };
  std::string dae = good;
  dae.replace(dae.find("</p>"), 4, "</q>");
  auto r = load_bytes(dae, "a.dae");
  expect_refused(r);
  EXPECT_NE(r.diagnostics[0].message.find("not well-formed"), std::string::npos) << r.diagnostics[0].message;
  EXPECT_EQ(r.diagnostics[0].line, line_of(dae, dae.find("</q>")));
  dae = good;
  dae.replace(dae.find("0 0 2</float_array>"), 5, "0 0 x");
  r = load_bytes(dae, "a.dae");
  expect_refused(r);
  EXPECT_NE(r.diagnostics[0].message.find("finite numbers"), std::string::npos) << r.diagnostics[0].message;
  EXPECT_EQ(r.diagnostics[0].line, line_of(dae, dae.find("0 0 x")));
}

TEST(Collada, NodesThatInstanceEachOtherAreRefused) {
  std::string dae = square_dae();
  dae.replace(dae.find("<translate>"), 0, "<instance_node url=\"#self\"/>");
  dae.replace(dae.find("<node>"), 6, "<node id=\"self\">");
  expect_refused(load_bytes(dae, "a.dae"));
}

TEST(Loader, ContentDecidesAndTheWrongEndingIsAWarning) {
  const auto r = load_bytes(square_ply_ascii(), "a.stl");
  ASSERT_TRUE(r.ok);
  EXPECT_EQ(r.format, Format::ply);
  ASSERT_EQ(r.diagnostics.size(), 1U);
  EXPECT_EQ(r.diagnostics[0].severity, base::Severity::warning);
  expect_refused(load_bytes("hello", "a.fbx"));
}

TEST(Loader, MissingFileFolderAndPipeAreErrorsAtOnce) {
  const Folder folder;
  expect_refused(load(folder / "none.stl"));
  expect_refused(load(folder / "."));
  ASSERT_EQ(::system(("mkfifo '" + folder / "pipe.stl" + "'").c_str()), 0);
  expect_refused(load(folder / "pipe.stl"));
  expect_refused(load(folder.write("empty.stl", "")));
}

TEST(Loader, LimitsRefuseWithTheNumberThatWasAllowed) {
  LoadOptions few;
  few.max_triangles = 11;
  for (const auto& [bytes, name] :
       {std::pair{cube_obj(), "a.obj"}, std::pair{binary_stl(std::vector<math::Vec3>(36)), "a.stl"}}) {
    const auto r = load_bytes(bytes, name, few);
    expect_refused(r);
    EXPECT_NE(r.diagnostics[0].message.find("at most 11 are allowed"), std::string::npos);
  }
  few = {};
  few.max_file_bytes = 10;
  expect_refused(load_bytes(cube_obj(), "a.obj", few));
}

}  // namespace
}  // namespace ambf::mesh
