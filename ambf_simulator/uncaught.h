// What the program says when memory or threads run out on any thread: one line instead of an abort with a stack.
#pragma once

namespace ambf::simulator {

// From now on an exception that nobody catches ends the program: with code 1 and one line where the system refused
// memory or a thread, else as before (abort). Call once, before other threads start.
void report_uncaught_exceptions();

}  // namespace ambf::simulator
