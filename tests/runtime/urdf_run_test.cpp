// A robot runs the same, bit for bit, whether its URDF file is loaded or the ADF file that it was converted to.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "adf/urdf_import.h"
#include "runtime/local_simulation.h"
#include "simulation_rig.h"
#include "state/frame.h"

namespace ambf::runtime {
namespace {

const std::string kInertial =
    "<inertial><origin xyz=\"0.02 0.01 -0.1\" rpy=\"0.1 0.2 0.3\"/><mass value=\"0.7\"/><inertia ixx=\"0.01\" "
    "ixy=\"0.001\" ixz=\"0\" iyy=\"0.02\" iyz=\"-0.001\" izz=\"0.015\"/></inertial>";

// An arm of a mesh, of several primitives and meshes (one of them mirrored), and of a link without mass, and a joint
// that follows.
const std::string kRobot =
    "<robot name=\"r\"><link name=\"base\"><visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual></link>"
    "<link name=\"upper\">" +
    kInertial +
    "<visual><origin xyz=\"0 0.1 0\" rpy=\"0.4 0 1\"/><geometry><mesh filename=\"wedge.stl\" scale=\"0.5 0.5 "
    "0.5\"/></geometry></visual><collision><geometry><sphere radius=\"0.05\"/></geometry></collision></link>"
    "<link name=\"lower\">" +
    kInertial +
    "<visual><origin xyz=\"0 0 0.1\"/><geometry><cylinder radius=\"0.03\" length=\"0.2\"/></geometry></visual>"
    "<visual><geometry><sphere radius=\"0.04\"/></geometry></visual>"
    "<visual><geometry><mesh filename=\"wedge.stl\" scale=\"0.3 -0.5 1\"/></geometry></visual>"
    "<visual><origin xyz=\"0.1 0 0\"/><geometry><mesh filename=\"wedge.stl\"/></geometry></visual>"
    "<collision><origin xyz=\"0.1 0 0\"/><geometry><mesh filename=\"wedge.stl\" scale=\"0.3 -0.5 1\"/>"
    "</geometry></collision>"
    "<collision><origin xyz=\"0 0 0.1\"/><geometry><cylinder radius=\"0.03\" length=\"0.2\"/></geometry></collision>"
    "<collision><geometry><sphere radius=\"0.04\"/></geometry></collision></link>"
    "<link name=\"tip\"><visual><geometry><box size=\"0.1 0.02 0.02\"/></geometry></visual></link>"
    "<joint name=\"shoulder\" type=\"revolute\"><parent link=\"base\"/><child link=\"upper\"/><origin xyz=\"0 0 1\" "
    "rpy=\"0.3 0 0\"/><axis xyz=\"0 1 0.5\"/><limit lower=\"-1\" upper=\"1\" effort=\"0.1\" velocity=\"1\"/>"
    "<dynamics damping=\"0.01\"/></joint>"
    "<joint name=\"elbow\" type=\"continuous\"><parent link=\"upper\"/><child link=\"lower\"/><origin xyz=\"0.2 0 "
    "-0.2\" rpy=\"0 1.5707963267948966 0\"/><axis xyz=\"1 0 0\"/><mimic joint=\"shoulder\" "
    "multiplier=\"-0.5\"/></joint>"
    "<joint name=\"glue\" type=\"fixed\"><parent link=\"lower\"/><child link=\"tip\"/><origin xyz=\"0 0 0.2\"/></joint>"
    "</robot>";

std::vector<std::uint64_t> hashes_of(const std::filesystem::path& file) {
  JudgedLog log;
  LocalSimulation simulation{test::free_running(), test::empty_world(), {}, log};
  state::LoadRequest request;
  request.path = file.string();
  const state::Outcome loaded = simulation.load(request);
  EXPECT_TRUE(loaded.success) << loaded.message;
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(simulation.step());
    hashes.push_back(state::state_hash(simulation.frame()));
  }
  return hashes;
}

TEST(UrdfRun, ConvertedAndLoadedDirectlyTheHashesAreEqual) {
  const std::filesystem::path home = testing::TempDir() + "ambf_urdf_run_" + std::to_string(getpid());
  std::filesystem::create_directories(home / "adf");
  std::ofstream(home / "wedge.stl") << "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0.2 0 0\n"
                                       "vertex 0 0.1 0\nendloop\nendfacet\nfacet normal 0 0 0\nouter loop\n"
                                       "vertex 0 0 0\nvertex 0 0.1 0\nvertex 0 0 0.3\nendloop\nendfacet\nendsolid a\n";
  std::ofstream(home / "r.urdf") << kRobot;
  const std::string path = (home / "adf/r.yaml").string();
  const adf::ConvertedUrdf converted = adf::convert_urdf_file((home / "r.urdf").string(), {false, false, path});
  ASSERT_TRUE(converted.adf);
  std::ofstream(path) << *converted.adf;
  const std::vector<std::uint64_t> direct = hashes_of(home / "r.urdf"), text = hashes_of(path);
  std::filesystem::remove_all(home);
  EXPECT_EQ(direct, text);
  EXPECT_NE(direct.front(), direct.back()) << "it moves";
}

}  // namespace
}  // namespace ambf::runtime
