#include "mesh/detail/file_stamp.h"

#include <sys/stat.h>
#include <time.h>

#include <cstring>

#include "mesh/detail/hash_seed.h"

namespace ambf::mesh {

namespace {

// File systems stamp with the kernel's tick (at most 10 ms); some margin for those of other machines.
constexpr std::int64_t kRacyWithin_ns = 50'000'000;

std::int64_t nanoseconds(const timespec& t) { return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec; }

}  // namespace

FileStamp stamp_of(const std::string& path) {
  FileStamp stamp;
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return stamp;
  stamp.exists = true;
  stamp.device = status.st_dev;
  stamp.inode = status.st_ino;
  stamp.size = static_cast<std::uint64_t>(status.st_size);
  stamp.modified_ns = nanoseconds(status.st_mtim);
  stamp.changed_ns = nanoseconds(status.st_ctim);
  stamp.racy = stamp.changed_ns > nanoseconds(now) - kRacyWithin_ns;
  return stamp;
}

bool surely_same(const FileStamp& a, const FileStamp& b) {
  if (!a.exists || !b.exists) return a.exists == b.exists;
  return !a.racy && a.device == b.device && a.inode == b.inode && a.size == b.size && a.modified_ns == b.modified_ns &&
         a.changed_ns == b.changed_ns;
}

ContentHash hash_of(std::string_view bytes) {
  const std::uint64_t seed = hash_seed();
  std::uint64_t low = seed ^ bytes.size(), high = ~seed + bytes.size();
  const auto mix = [&low, &high, seed](std::uint64_t word) {
    low = (low ^ word) * 0x9E3779B97F4A7C15ULL;
    low ^= low >> 32;
    high = (high + (word ^ ~seed)) * 0xC2B2AE3D27D4EB4FULL;
    high ^= high >> 29;
  };
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    mix(word);
  }
  std::uint64_t tail = 0;
  if (at < bytes.size()) std::memcpy(&tail, bytes.data() + at, bytes.size() - at);
  mix(tail);
  return {low, high};
}

}  // namespace ambf::mesh
