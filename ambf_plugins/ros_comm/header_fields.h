// Connection headers whose fields claim more bytes than came. roscpp's parser believes a field's length up to 1 MB and
// reads beyond the header: one of 8 bytes can end the process. Private to ros_comm. C++17.
#pragma once

namespace ambf::ros_comm {

// Finds the library's parser, which the checking one in header_fields.cpp stands in front of. Before ROS is started.
// False: this program's parser is not the one that roscpp calls (a linker option, another version).
bool check_header_fields();

}  // namespace ambf::ros_comm
