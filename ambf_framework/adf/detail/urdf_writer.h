// A planned URDF robot as ADF text (EQUATIONS 13, the dissertation's Alg. 3), and the files its meshes mean.
#pragma once

#include <string>
#include <vector>

#include "adf/detail/urdf_tree.h"

namespace ambf::adf::urdf {

// The files that a mesh's name may mean, best first: package://name/... by ROS_PACKAGE_PATH and by the package.xml
// above the URDF file; file://...; else from the folder of the URDF file.
std::vector<std::string> mesh_places(const std::string& name, const std::string& urdf_path);

struct Written {
  std::string adf;
  std::map<std::string, int> line_of_block;
};

struct Paths {
  std::string urdf;
  std::string adf;  // meshes are named from its folder; empty: as they were found
};

Written write_adf(const Plan& plan, const std::string& robot, const Paths& paths, const Warn& warn);

}  // namespace ambf::adf::urdf
