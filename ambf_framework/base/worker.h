// One question to a worker program, which may crash, hang, or answer nonsense: it is started for the question, and it
// is gone and waited for when ask() returns. Blocks; never on the physics thread. The worker has one socket, as its
// standard input and output, no other descriptor of ours, and what it reports as errors is discarded.
//
// Both sides send messages: a WorkerMessage, then `size` bytes. First comes our question; then the worker may ask for
// files, one at a time, and ends with its answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ambf::base {

enum class WorkerMessageKind : std::uint64_t {
  question = 0x616d6266'00000001,
  file_wanted,   // from the worker: its name
  file_found,    // to the worker: its bytes
  file_missing,  // to the worker: empty
  answer,        // from the worker
};

struct WorkerMessage {
  WorkerMessageKind kind = WorkerMessageKind::question;
  std::uint64_t size = 0;  // bytes that follow
};

inline constexpr int kWorkerOutOfMemory = 80;  // exit status of a worker that reached its limit of memory

struct WorkerLimits {
  double silence_s = 5.0;  // without a byte from the worker
  double total_s = 60.0;
  std::size_t max_answer_bytes = std::size_t{1} << 30;
  std::size_t max_files = 2000;
};

struct WorkerCall {
  std::string program;
  WorkerLimits limits;
  // The bytes of a file that the worker names; none: there is no such file.
  std::function<std::optional<std::string>(const std::string& name)> file;
};

struct WorkerAnswer {
  bool ok = false;
  std::string bytes;    // as the worker sent them, unchecked
  std::string problem;  // what became of the worker: "it crashed (Segmentation fault)"
};

WorkerAnswer ask_worker(const WorkerCall& call, std::string_view question);

// The path of a program of ours that is installed in the folder ambf/ beside the library (or program) that this code
// is in. Not checked to exist.
std::string program_beside_library(const std::string& name);

}  // namespace ambf::base
