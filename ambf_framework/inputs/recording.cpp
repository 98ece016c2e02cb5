#include "inputs/recording.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "base/hash.h"

namespace ambf::inputs {

namespace {

template <class T>
bool read_value(std::istream& input, T& value) {
  return static_cast<bool>(input.read(reinterpret_cast<char*>(&value), sizeof value));
}

}  // namespace

std::unique_ptr<Recording> Recording::open(const std::string& path, std::string& problem) {
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file) {
    problem = "cannot read '" + path + "': " + std::strerror(errno);
    return nullptr;
  }
  auto recording = read(std::move(file), problem);
  if (recording == nullptr) problem = "'" + path + "': " + problem;
  return recording;
}

std::unique_ptr<Recording> Recording::read(std::unique_ptr<std::istream> bytes, std::string& problem) {
  auto recording = std::unique_ptr<Recording>(new Recording(std::move(bytes)));
  std::istream& input = *recording->input_;
  input.seekg(0, std::ios::end);
  const std::streamoff size = input.tellg();
  input.seekg(0);
  char magic[sizeof kMagic] = {};
  std::uint32_t version = 0;
  if (size < 0 || !input.read(magic, sizeof magic) || std::memcmp(magic, kMagic, sizeof magic) != 0) {
    problem = "this is no recording of inputs (ambf_simulator --record-input makes them)";
    return nullptr;
  }
  if (!read_value(input, version) || version != kVersion) {
    problem = "a recording of version " + std::to_string(version) + "; this simulator reads version " +
              std::to_string(kVersion);
    return nullptr;
  }
  recording->left_ = static_cast<std::uint64_t>(size) - sizeof magic - sizeof version;
  const RawRecord* first = recording->next(kSceneStream);
  const std::optional<SessionRecord> session = first == nullptr ? std::nullopt : first->as<SessionRecord>();
  if (!session) {
    problem = "the recording ends before it begins";
    return nullptr;
  }
  recording->session_ = *session;
  return recording;
}

// False at the end, and at the first record that is damaged.
bool Recording::read_record(RawRecord& record, Stream& stream) {
  if (at_end_) return false;
  RecordHead head;
  std::uint32_t checksum = 0;
  const std::uint64_t before = left_;
  const auto stop = [&] {
    at_end_ = true;
    ignored_ = before;
    return false;
  };
  if (left_ < sizeof head + sizeof checksum || !read_value(*input_, head)) return stop();
  if (head.size > left_ - sizeof head - sizeof checksum) return stop();
  record.bytes.resize(head.size);
  if (!input_->read(reinterpret_cast<char*>(record.bytes.data()), head.size) || !read_value(*input_, checksum)) {
    return stop();
  }
  base::Fnv1a hash;
  hash.add_bytes(&head, sizeof head);
  hash.add_bytes(record.bytes.data(), record.bytes.size());
  if (static_cast<std::uint32_t>(hash.value()) != checksum) {
    damaged_ = true;
    return stop();
  }
  left_ -= sizeof head + head.size + sizeof checksum;
  record.type = head.type;
  stream = head.stream;
  if (record.type == Type::end) ended_ = true;
  if (const auto gap = record.as<GapRecord>(); gap && !gap_) gap_ = gap->stream;
  return true;
}

bool Recording::fill(Stream stream) {
  std::deque<RawRecord>& wanted = waiting_[stream];
  while (wanted.empty()) {
    RawRecord record;
    Stream of = 0;
    if (!read_record(record, of)) return false;
    waiting_[of].push_back(std::move(record));
  }
  return true;
}

const RawRecord* Recording::peek(Stream stream) { return fill(stream) ? &waiting_[stream].front() : nullptr; }

const RawRecord* Recording::next(Stream stream) {
  if (!fill(stream)) return nullptr;
  RawRecord& given = given_[stream];
  given = std::move(waiting_[stream].front());
  waiting_[stream].pop_front();
  return &given;
}

bool Recording::next_of_any(RawRecord& record, Stream& stream) { return read_record(record, stream); }

}  // namespace ambf::inputs
