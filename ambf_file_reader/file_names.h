// Names of files as some formats write them. Pure functions.
#pragma once

#include <string>

namespace ambf::file_reader {

// "wood%20dark.png" -> "wood dark.png", as glTF writes URIs.
std::string decoded_uri(const std::string& uri);

// An X3D text whose lists of places, url='"wood.png" "http://..."', are their first place alone: assimp 5.2 refuses a
// list of one, and joins longer ones.
std::string with_plain_urls(std::string x3d);

}  // namespace ambf::file_reader
