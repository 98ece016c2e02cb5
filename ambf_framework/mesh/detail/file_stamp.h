// Private to mesh/: has a file changed? By its stat where that can be trusted, else by its content.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ambf::mesh {

struct FileStamp {
  bool exists = false;
  // Changed so short a time before the stamp was taken that another change could leave the same stamp: never equal to
  // any.
  bool racy = false;
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t modified_ns = 0, changed_ns = 0;
};

FileStamp stamp_of(const std::string& path);
bool surely_same(const FileStamp& a, const FileStamp& b);

// 128 bits, seeded at random once per process: equal only for equal bytes, also for files made on purpose.
struct ContentHash {
  std::uint64_t low = 0, high = 0;
  bool operator<(const ContentHash& o) const { return low != o.low ? low < o.low : high < o.high; }
  bool operator==(const ContentHash& o) const { return low == o.low && high == o.high; }
};
ContentHash hash_of(std::string_view bytes);

}  // namespace ambf::mesh
