// Is a file that was dropped on a window worth handing to the loader? Looks at name and kind only. Any thread but the physics thread.
#pragma once

#include <string>

namespace ambf::render {

// Empty when it is; else what to tell the user.
std::string refusal_of_drop(const std::string& path);

}  // namespace ambf::render
