// Whether a file dropped on a window can be loaded, by its name and type. Any thread but the physics thread.
#pragma once

#include <string>

namespace ambf::render {

// Empty when it can; else a message for the user.
std::string refusal_of_drop(const std::string& path);

}  // namespace ambf::render
