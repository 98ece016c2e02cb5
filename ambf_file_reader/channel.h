// The worker's end of the conversation in base/worker.h: standard input and output. One thread. When the other side is
// gone the process ends.
#pragma once

#include <optional>
#include <string>

namespace ambf::file_reader {

std::string receive_question();
// A file that the one being read refers to, by the name that stands in it; none: there is no such file.
std::optional<std::string> request_file(const std::string& name);
void send_answer(const std::string& bytes);

}  // namespace ambf::file_reader
