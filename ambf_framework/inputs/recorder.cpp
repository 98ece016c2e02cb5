#include "inputs/recorder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "base/hash.h"
#include "base/realtime.h"

namespace ambf::inputs {

namespace {

constexpr std::chrono::milliseconds kWritePeriod{50};
// Several seconds of steps at 1 kHz, and of cycles: a disk may stall for as long.
constexpr std::size_t kPhysicsRing = std::size_t{8} << 20, kDeviceRing = std::size_t{2} << 20;

}  // namespace

std::unique_ptr<Recorder> Recorder::create(const std::string& path, const SessionRecord& session, base::Log& log,
                                           std::string& problem) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK, 0666);
  struct stat there {};
  if (file < 0 || fstat(file, &there) != 0 || !S_ISREG(there.st_mode)) {
    problem = "cannot record inputs in '" + path + "': " + (file < 0 ? std::strerror(errno) : "not an ordinary file");
    if (file >= 0) close(file);
    return nullptr;
  }
  auto recorder = std::unique_ptr<Recorder>(new Recorder(path, file, log));
  recorder->add(session);
  recorder->thread_ = std::thread([raw = recorder.get()] { raw->run(); });
  return recorder;
}

Recorder::Recorder(std::string path, int file, base::Log& log) : path_(std::move(path)), file_(file), log_(log) {}

Recorder::~Recorder() {
  stop_ = true;
  stopping_.notify_all();
  if (thread_.joinable()) thread_.join();
  close(file_);
}

Channel& Recorder::make_channel(Stream stream) {
  auto channel = std::make_unique<Channel>(stream, stream == kPhysicsStream ? kPhysicsRing : kDeviceRing);
  const std::lock_guard lock(mutex_);
  return *channels_.emplace_back(std::move(channel));
}

void Recorder::run() {
  base::set_thread_name("input record");
  Bytes start(kMagic, kMagic + sizeof kMagic);
  Writer(start, true)(kVersion);
  failed_ = !write(start);
  if (failed_) log_.error("the recording of inputs in '%s' ends here: %s", path_.c_str(), std::strerror(errno));
  while (!stop_) {
    const std::uint32_t seen = stopping_.count();
    drain();
    if (!stop_) stopping_.wait_beyond(seen, kWritePeriod);
  }
  add(EndRecord{});
  drain();
}

// Channels before the scene, so that the scene's end record is the last one. A gap is noted after what came before it.
void Recorder::drain() {
  framed_.clear();
  std::vector<Channel*> channels;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& channel : channels_) channels.push_back(channel.get());
  }
  for (Channel* channel : channels) {
    const bool closed = channel->closed_.load(std::memory_order_acquire);
    taken_.clear();
    channel->ring_.pop_all(taken_);
    frame(taken_);
    if (!closed || channel->gap_written_) continue;
    channel->gap_written_ = true;
    log_.warning("'%s': the recording of inputs has a gap; it can be replayed up to here", path_.c_str());
    add(GapRecord{channel->stream_});
  }
  taken_.clear();
  {
    const std::lock_guard lock(mutex_);
    taken_.swap(scene_);
  }
  frame(taken_);
  if (failed_ || framed_.empty() || write(framed_)) return;
  failed_ = true;
  log_.error("the recording of inputs in '%s' ends here: %s", path_.c_str(), std::strerror(errno));
}

// Adds each record's checksum.
void Recorder::frame(const Bytes& records) {
  for (std::size_t at = 0; at < records.size();) {
    RecordHead head;
    std::memcpy(&head, records.data() + at, sizeof head);
    const std::size_t size = sizeof head + head.size;
    base::Fnv1a hash;
    hash.add_bytes(records.data() + at, size);
    framed_.insert(framed_.end(), records.data() + at, records.data() + at + size);
    Writer(framed_, true)(static_cast<std::uint32_t>(hash.value()));
    at += size;
  }
}

bool Recorder::write(const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EINTR) return false;
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  return true;
}

}  // namespace ambf::inputs
