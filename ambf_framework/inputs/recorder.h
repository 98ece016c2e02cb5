// Writes a recording of inputs. Real-time threads leave their records in a ring of their own, which a thread of the
// recorder empties 20 times a second: after kill -9 the file is valid up to then. Nobody waits for the disk. When it is
// full, the recording ends with one line in the log and the simulation goes on.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/event_count.h"
#include "base/log.h"
#include "inputs/byte_ring.h"
#include "inputs/bytes.h"
#include "inputs/records.h"

namespace ambf::inputs {

// As it is in a ring and in the file: size, type and stream before a record's bytes; in the file their checksum behind.
struct RecordHead {
  std::uint32_t size = 0;  // of what follows the head
  Type type{};
  Stream stream = 0;
};
static_assert(sizeof(RecordHead) == 8);

template <class Record>
bool append(Bytes& buffer, Stream stream, const Record& record, bool grows) {
  buffer.clear();
  buffer.resize(sizeof(RecordHead));
  Writer writer(buffer, grows);
  Record::members(record, writer);
  const RecordHead head{static_cast<std::uint32_t>(buffer.size() - sizeof head), Record::kType, stream};
  std::memcpy(buffer.data(), &head, sizeof head);
  return writer.good();
}

// One real-time producer's way into the file. A record that finds no room, or has no form in the file, closes it: what
// would come after a gap could not be replayed.
class Channel {
 public:
  Channel(Stream stream, std::size_t ring_bytes) : stream_(stream), ring_(ring_bytes) { scratch_.reserve(kMaxRecord); }

  // Its producer; neither waits nor allocates.
  template <class Record>
  void add(const Record& record) {
    if (closed_.load(std::memory_order_relaxed)) return;
    if (append(scratch_, stream_, record, false) && ring_.try_push(scratch_.data(), scratch_.size())) return;
    closed_.store(true, std::memory_order_release);
  }

 private:
  friend class Recorder;
  static constexpr std::size_t kMaxRecord = std::size_t{64} << 10;  // a command to base::kMaxJointCommands joints fits

  const Stream stream_;
  ByteRing ring_;
  Bytes scratch_;
  std::atomic<bool> closed_{false};
  bool gap_written_ = false;  // the recorder's thread
};

class Recorder {
 public:
  // Null, with `problem`: the file cannot be made. It must be new or an ordinary file, which is replaced. `log` must
  // outlive it.
  static std::unique_ptr<Recorder> create(const std::string& path, const SessionRecord& session, base::Log& log,
                                          std::string& problem);
  ~Recorder();  // writes what is there, and that it is the end; all producers must have ended
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Made once for each real-time producer. Not the physics thread or a device's (allocates); valid as long as this.
  Channel& make_channel(Stream stream);
  // Records of the scene stream: any thread that may wait.
  template <class Record>
  void add(const Record& record) {
    const std::lock_guard lock(mutex_);
    Bytes bytes;
    append(bytes, kSceneStream, record, true);
    scene_.insert(scene_.end(), bytes.begin(), bytes.end());
  }

 private:
  Recorder(std::string path, int file, base::Log& log);
  void run();
  void drain();
  void frame(const Bytes& records);
  bool write(const Bytes& bytes);

  const std::string path_;
  const int file_;
  base::Log& log_;
  std::mutex mutex_;  // channels_, scene_
  std::vector<std::unique_ptr<Channel>> channels_;
  Bytes scene_;
  Bytes taken_, framed_;  // the recorder's thread's
  bool failed_ = false;   // likewise
  std::atomic<bool> stop_{false};
  base::EventCount stopping_;
  std::thread thread_;
};

}  // namespace ambf::inputs
