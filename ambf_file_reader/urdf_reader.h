// A URDF text as urdfdom reads it, with the lines that urdfdom forgets. One thread; may crash with TinyXML.
#pragma once

#include <string>

#include "adf/detail/urdf_answer.h"

namespace ambf::file_reader {

adf::urdf::Robot read_urdf(const std::string& text);

}  // namespace ambf::file_reader
