// Counts what a device's loop must never do: use the allocator, lock a mutex, wait on a futex. Where interposer.cpp is
// linked into a test program, its functions stand before those of the C library for the whole process, shared libraries
// included (a condition variable's wait begins with the lock of its mutex). Any thread.
#pragma once

namespace ambf::devices::testing {

struct Calls {
  long memory = 0;  // malloc, calloc, realloc, free
  long locks = 0;   // pthread_mutex_lock
  long waits = 0;   // futex waits by syscall()
  long loops = 0;   // threads that count
};
// Of the calling thread, since it started.
const Calls& calls_of_this_thread();
// Of all threads of devices (called "device 0" and so on), each from the first sleep of its loop on.
Calls calls_in_device_loops();

}  // namespace ambf::devices::testing
