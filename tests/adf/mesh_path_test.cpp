#include <filesystem>
#include <fstream>

#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

namespace fs = std::filesystem;

// A folder with files in it, gone at the end.
class MeshPath : public ::testing::Test {
 protected:
  MeshPath() : folder_(fs::temp_directory_path() / ("ambf_adf_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~MeshPath() override { fs::remove_all(folder_); }

  void make(const std::string& file) {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << "solid\n";
  }
  std::string at(const std::string& file) const { return (folder_ / file).string(); }
  ModelResult load(const std::string& header, const std::string& body) {
    std::ofstream(folder_ / "m.yaml") << "bodies: [A]\nnamespace: /t/\n"
                                      << header << "\nA: {name: A, mass: 1, " << body << "}\n";
    return load_model(at("m.yaml"));
  }
  static const scene::Body& body(const ModelResult& result) { return result.model->bodies.at(0); }

  fs::path folder_;
};

TEST_F(MeshPath, VisualIsInTheHighAndCollisionInTheLowResolutionPath) {
  make("high/a.STL");
  make("low/a.STL");
  const ModelResult result = load("high resolution path: ./high/\nlow resolution path: low", "mesh: a.STL");
  EXPECT_EQ(body(result).visual.mesh_file, at("high/a.STL"));
  EXPECT_EQ(body(result).collision.mesh_file, at("low/a.STL"));
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST_F(MeshPath, CollisionMeshGoesBeforeMeshAndHighPathServesWhereNoLowOneIsGiven) {
  make("high/a.STL");
  make("high/b.STL");
  const ModelResult result = load("high resolution path: high", "mesh: a.STL, collision mesh: b.STL");
  EXPECT_EQ(body(result).collision.mesh_file, at("high/b.STL"));
}

TEST_F(MeshPath, BodyPathReplacesTheHeadersAndBothJoinedIsTriedNext) {
  make("own/a.STL");
  make("high/own/a.STL");
  make("high/only_joined/a.STL");
  EXPECT_EQ(body(load("high resolution path: high", "mesh: a.STL, high resolution path: own")).visual.mesh_file,
            at("own/a.STL"));
  EXPECT_EQ(body(load("high resolution path: high", "mesh: a.STL, high resolution path: only_joined")).visual.mesh_file,
            at("high/only_joined/a.STL"));
}

TEST_F(MeshPath, MissingMeshIsAnErrorOfThatMeshAndTheBodyStays) {
  make("high/a.STL");
  const ModelResult result = load("high resolution path: high\nlow resolution path: low", "mesh: a.STL");
  EXPECT_EQ(body(result).visual.mesh_file, at("high/a.STL"));
  EXPECT_EQ(body(result).collision.mesh_file, "");
  EXPECT_EQ(count(result.diagnostics, base::Severity::error), 1u);
  EXPECT_TRUE(says(result.diagnostics,
                   "m.yaml:5:[0-9]+: error: \\[A: mesh\\] collision mesh not found; looked at: .*/low/a.STL"));
}

TEST_F(MeshPath, ExtensionMayBeWrittenInAnotherCase) {
  make("a.STL");
  EXPECT_EQ(body(load("", "mesh: a.stl")).visual.mesh_file, at("a.STL"));
}

TEST_F(MeshPath, EmptyMeshMeansNone) {
  const ModelResult result = load("", "mesh: ''");
  EXPECT_EQ(body(result).visual.mesh_file, "");
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST_F(MeshPath, FolderIsNoMesh) {
  fs::create_directories(folder_ / "a.STL");
  EXPECT_TRUE(says(load("", "mesh: a.STL").diagnostics, "visual mesh not found"));
}

TEST_F(MeshPath, MissingShadersAreAWarningAndLeftOut) {
  const ModelResult result = load("", "shaders: {path: s, vertex: v.vs, fragment: f.fs}");
  EXPECT_FALSE(body(result).visual.shaders.given());
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[A: shaders/vertex\\] no such file: .*s/v.vs"));
}

TEST_F(MeshPath, WithoutLookingBothPlacesAreHandedOn) {
  Options options;
  options.look_for_files = false;
  const ModelResult result = parse_model(
      "bodies: [A]\nhigh resolution path: high\nA: {name: A, mass: 1, mesh: a.STL, high resolution path: own}\n",
      "/m/m.yaml", options);
  EXPECT_EQ(body(result).visual.mesh_file, "/m/own/a.STL");
  EXPECT_EQ(body(result).visual.mesh_candidates, (std::vector<std::string>{"/m/high/own/a.STL"}));
}

}  // namespace
}  // namespace ambf::adf
