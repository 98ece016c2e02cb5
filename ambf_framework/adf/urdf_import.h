// Robots written as URDF, as ADF: urdfdom reads the text in the process ambf_file_reader (it may crash on malformed
// files), the answer becomes ADF text, and that is parsed as any other model. Loading a URDF file and loading what it
// was converted to are the same by construction. Any thread but the physics thread; never throws.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "adf/adf.h"

namespace ambf::adf {

struct ConvertedUrdf {
  std::optional<std::string> adf;  // none: refused, and diagnostics hold an error
  base::Diagnostics diagnostics;   // with lines of the URDF text
  std::map<std::string, int> line_of_block;
};

// Whether the text is XML with an element `robot`, perhaps with macros of xacro.
bool is_urdf(const std::string& text);

// Of XML without such an element, the name of its first one (empty: it has none); nothing of any other text.
std::optional<std::string> other_xml(const std::string& text);

// `path` is used in messages; meshes are looked up from its folder and by package:// in ROS_PACKAGE_PATH.
ConvertedUrdf convert_urdf(const std::string& text, const std::string& path, const UrdfOptions& options = {});

ConvertedUrdf convert_urdf_file(const std::string& path, const UrdfOptions& options = {});

// As parse_model. `document` of the result is that of the ADF text.
ModelResult parse_urdf(const std::string& text, const std::string& path, const Options& options);

}  // namespace ambf::adf
