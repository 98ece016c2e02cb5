#include "base/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace ambf::base {

namespace {

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// The file that a symbolic link leads to; `path` itself where there is none yet.
std::string behind_links(const std::string& path) {
  char* real = ::realpath(path.c_str(), nullptr);
  if (real == nullptr) return path;
  std::string result(real);
  std::free(real);
  return result;
}

// A rename is on the disk only once its folder is. Without effect where folders cannot be synchronised.
void sync_folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

std::string write_whole_file(const std::string& path, std::string_view bytes, IfExists if_exists) {
  const auto refused = [&path](const std::string& why) { return "cannot write '" + path + "': " + why; };
  const auto failed = [&refused] { return refused(std::strerror(errno)); };
  const std::string target = behind_links(path);
  struct stat there {};
  const bool exists = ::stat(target.c_str(), &there) == 0;
  if (exists && !S_ISREG(there.st_mode)) return refused("it is there, and not an ordinary file");
  if (exists && if_exists == IfExists::refuse) return refused("it exists; choose another name or remove it");
  if (exists && ::access(target.c_str(), W_OK) != 0) return failed();  // a rename would not mind

  static std::atomic<unsigned> next{0};
  const std::string part = target + "." + std::to_string(::getpid()) + "-" + std::to_string(next++) + ".part";
  const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor < 0) return failed();
  const bool written = (!exists || ::fchmod(descriptor, there.st_mode & 07777) == 0) && write_all(descriptor, bytes) &&
                       ::fsync(descriptor) == 0;
  std::string problem = written ? "" : failed();
  if (::close(descriptor) != 0 && problem.empty()) problem = failed();
  if (problem.empty()) {
    // link() fails where somebody made the file in the meantime; rename() would replace it.
    const bool placed = if_exists == IfExists::replace ? std::rename(part.c_str(), target.c_str()) == 0
                                                       : ::link(part.c_str(), target.c_str()) == 0;
    if (!placed) problem = failed();
  }
  ::unlink(part.c_str());
  if (problem.empty()) sync_folder_of(target);
  return problem;
}

}  // namespace ambf::base
