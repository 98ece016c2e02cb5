// What the process may do once it begins to parse a stranger's file. Called first, before any thread.
#pragma once

#include <sys/types.h>

namespace ambf::file_reader {

// 1 GiB of memory (an allocation beyond it ends the process with base::kWorkerOutOfMemory), 20 s of processor time, no
// file written or opened, no core, no privileges gained, ordinary scheduling, no descriptor but the standard streams;
// and an end with `parent`, the process that started this one.
void limit_this_process(pid_t parent);

}  // namespace ambf::file_reader
