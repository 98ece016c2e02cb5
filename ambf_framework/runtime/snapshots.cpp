#include "runtime/detail/snapshots.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/bounds.h"
#include "model/saved_state.h"

namespace ambf::runtime {

namespace {

constexpr std::size_t kShownName = 80;  // characters
constexpr std::size_t kMegabyte = std::size_t{1} << 20;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string failed(const char* verb, const std::string& path) {
  return std::string("cannot ") + verb + " '" + path + "': " + std::strerror(errno);
}

class File {
 public:
  File(const std::string& path, int flags) : descriptor_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~File() { close(); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  // Errors of delayed writes come with it.
  bool close() {
    const bool good = descriptor_ < 0 || ::close(descriptor_) == 0;
    descriptor_ = -1;
    return good;
  }

 private:
  int descriptor_;
};

bool write_all(int descriptor, const std::vector<std::uint8_t>& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(descriptor, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EINTR) return false;
    done += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  return true;
}

// Appends up to `count` bytes; fewer where the file ends.
bool read_more(int descriptor, std::size_t count, std::vector<std::uint8_t>& bytes) {
  std::size_t done = bytes.size();
  bytes.resize(done + count);
  while (done < bytes.size()) {
    const ssize_t got = read(descriptor, bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno != EINTR) return false;
    if (got == 0) break;
    done += got > 0 ? static_cast<std::size_t>(got) : 0;
  }
  bytes.resize(done);
  return true;
}

}  // namespace

std::string shown_name(const std::string& name) {
  std::string shown = name.substr(0, kShownName);
  std::replace_if(shown.begin(), shown.end(), is_control, '?');
  return shown + (name.size() > kShownName ? "..." : "");
}

std::string Snapshots::refusal(const std::string& name) const {
  if (name.size() > base::kMaxSnapshotName) {
    return "a snapshot's name has at most " + std::to_string(base::kMaxSnapshotName) + " bytes, this one " +
           std::to_string(name.size());
  }
  if (std::any_of(name.begin(), name.end(), is_control)) return "a snapshot's name must not hold control characters";
  const std::lock_guard lock(mutex_);
  const auto replaced = states_.find(name);
  const std::size_t count = states_.size() - (replaced == states_.end() ? 0 : 1);
  const std::size_t bytes = bytes_ - (replaced == states_.end() ? 0 : replaced->second.size());
  if (count < base::kMaxSnapshots && bytes < base::kMaxSnapshotBytes) return {};
  return std::to_string(count) + " snapshots of " + std::to_string(bytes / kMegabyte) +
         " MB are kept; no more are taken beyond " + std::to_string(base::kMaxSnapshots) + " or " +
         std::to_string(base::kMaxSnapshotBytes / kMegabyte) + " MB: forget some (World/Forget)";
}

std::string Snapshots::keep(std::string name, std::vector<std::uint8_t> bytes) {
  const std::lock_guard lock(mutex_);
  if (name.empty()) {
    do name = "snapshot" + std::to_string(next_++);
    while (states_.count(name) != 0);
  }
  std::vector<std::uint8_t>& kept = states_[name];
  bytes_ += bytes.size() - kept.size();
  kept = std::move(bytes);
  return name;
}

bool Snapshots::forget(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = states_.find(name);
  if (found == states_.end()) return false;
  bytes_ -= found->second.size();
  states_.erase(found);
  return true;
}

const std::vector<std::uint8_t>* Snapshots::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = states_.find(name);
  return found == states_.end() ? nullptr : &found->second;
}

std::vector<std::string> Snapshots::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : states_) names.push_back(name);
  return names;
}

std::string check_state_path(const std::string& path) {
  if (path.size() > base::kMaxPath) {
    return "a path has at most " + std::to_string(base::kMaxPath) + " bytes, this one " + std::to_string(path.size());
  }
  if (std::any_of(path.begin(), path.end(), is_control)) return "a path must not hold control characters";
  return {};
}

std::string write_state_file(const std::string& path, const std::vector<std::uint8_t>& bytes) {
  struct stat there {};
  if (stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode)) {
    return "cannot write '" + path + "': it is there, and not an ordinary file";
  }
  // Whatever else is called so (a file that somebody left, a pipe) is not opened: O_EXCL.
  static std::atomic<unsigned> next{0};
  const std::string part = path + "." + std::to_string(getpid()) + "-" + std::to_string(next++) + ".part";
  File file(part, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (!file.is_open()) return failed("write", path);
  if (!write_all(file.descriptor(), bytes) || !file.close()) {
    const std::string why = failed("write", path);
    std::remove(part.c_str());
    return why;
  }
  if (std::rename(part.c_str(), path.c_str()) == 0) return {};
  const std::string why = failed("write", path);
  std::remove(part.c_str());
  return why;
}

std::string read_state_file(const std::string& path, const HeadCheck& fits, std::vector<std::uint8_t>& bytes) {
  const File file(path, O_RDONLY | O_NONBLOCK);  // opening a pipe must not wait for its other end
  struct stat there {};
  if (!file.is_open() || fstat(file.descriptor(), &there) != 0) return failed("read", path);
  if (!S_ISREG(there.st_mode)) return "cannot read '" + path + "': not an ordinary file";
  bytes.clear();
  if (!read_more(file.descriptor(), model::kStateHeadBytes, bytes)) return failed("read", path);
  if (std::string why = fits(bytes); !why.empty()) return why;
  const auto size = static_cast<std::size_t>(there.st_size);
  if (size > base::kMaxSnapshotBytes) {
    return "'" + path + "' has " + std::to_string(size / kMegabyte) + " MB; state files have at most " +
           std::to_string(base::kMaxSnapshotBytes / kMegabyte) + " MB";
  }
  if (size > bytes.size() && !read_more(file.descriptor(), size - bytes.size(), bytes)) return failed("read", path);
  return {};
}

}  // namespace ambf::runtime
