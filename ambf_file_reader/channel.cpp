#include "channel.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "base/worker.h"

namespace ambf::file_reader {

namespace {

using base::WorkerMessage;
using base::WorkerMessageKind;

void read_all(void* to, std::size_t size) {
  auto* bytes = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t got = ::read(STDIN_FILENO, bytes, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) std::_Exit(1);
    bytes += got;
    size -= static_cast<std::size_t>(got);
  }
}

void write_all(const void* from, std::size_t size) {
  const auto* bytes = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t put = ::write(STDOUT_FILENO, bytes, size);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) std::_Exit(1);
    bytes += put;
    size -= static_cast<std::size_t>(put);
  }
}

void send(WorkerMessageKind kind, const std::string& bytes) {
  const WorkerMessage head{kind, bytes.size()};
  write_all(&head, sizeof head);
  write_all(bytes.data(), bytes.size());
}

std::string receive(WorkerMessageKind& kind) {
  WorkerMessage head;
  read_all(&head, sizeof head);
  std::string bytes(head.size, '\0');
  read_all(bytes.data(), bytes.size());
  kind = head.kind;
  return bytes;
}

}  // namespace

std::string receive_question() {
  WorkerMessageKind kind{};
  std::string question = receive(kind);
  if (kind != WorkerMessageKind::question) std::_Exit(1);
  return question;
}

std::optional<std::string> request_file(const std::string& name) {
  send(WorkerMessageKind::file_wanted, name);
  WorkerMessageKind kind{};
  std::string bytes = receive(kind);
  if (kind != WorkerMessageKind::file_found) return std::nullopt;
  return bytes;
}

void send_answer(const std::string& bytes) { send(WorkerMessageKind::answer, bytes); }

}  // namespace ambf::file_reader
