// Private to mesh/: which format a file has, by its content where that is certain, else by its name. Pure functions.
#pragma once

#include <string>
#include <string_view>

#include "mesh/loader.h"

namespace ambf::mesh {

struct Recognised {
  Format format = Format::unknown;
  std::string ending;      // of Format::imported: without the dot, in lower case; what the importer is chosen by
  std::string name;        // for messages: "STL", "glTF"
  bool as_named = true;    // false: the name of the file ends otherwise
  std::string refused_as;  // of an ending that is no mesh: "text without a fixed form"; empty otherwise
};

Recognised recognise(const std::string& path, std::string_view bytes);

}  // namespace ambf::mesh
