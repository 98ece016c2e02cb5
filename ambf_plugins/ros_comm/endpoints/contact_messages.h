// Contacts in messages of our own: those of the world. Private to ros_comm. Publisher thread. C++17.
#pragma once

#include <ambf_msgs/WorldContacts.h>

#include "state/frame.h"

namespace ambf::ros_comm {

void fill(const state::Frame& frame, ambf_msgs::WorldContacts& message);

}  // namespace ambf::ros_comm
