// Tells threads that a frame, a command or a request has arrived: see base/event_count.h. Any thread; C++17.
#pragma once

#include "base/event_count.h"

namespace ambf::exchange {

using Signal = base::EventCount;

}  // namespace ambf::exchange
