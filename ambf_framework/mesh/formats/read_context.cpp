#include "mesh/formats/read_context.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace fs = std::filesystem;

namespace {
constexpr std::size_t kLongestName = 1000;
constexpr std::size_t kMaxTextures = 1000;

std::string mebibytes(std::size_t bytes) { return std::to_string((bytes + (1U << 20) - 1) >> 20) + " MiB"; }

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// A file in `folder` whose name differs from `name` in letter case only.
std::string find_ignoring_case(const fs::path& folder, const std::string& name) {
  std::error_code error;
  std::string found;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string candidate = it->path().filename().string();
    // The alphabetically first, so that the answer does not depend on the file system's order.
    if (equal_ignoring_case(candidate, name) && is_file(it->path()) && (found.empty() || it->path().string() < found)) {
      found = it->path().string();
    }
  }
  return found;
}
}  // namespace

ReadContext::ReadContext(const std::string& path, const LoadOptions& options, LoadResult& result)
    : path_(path), folder_(fs::path(path).parent_path().string()), options_(options), result_(result) {}

bool ReadContext::fail(const std::string& message, const std::string& hint, int line) {
  result_.diagnostics.push_back({base::Severity::error, path_, line, 0, "", "", message, hint});
  return false;
}

bool ReadContext::not_understood(const std::string& message, const std::string& hint, int line) {
  not_understood_ = true;
  return fail(message, hint, line);
}

void ReadContext::warn(const std::string& message, const std::string& hint, int line) {
  result_.diagnostics.push_back({base::Severity::warning, path_, line, 0, "", "", message, hint});
}

void ReadContext::inform(const std::string& message, const std::string& hint, int line) {
  result_.diagnostics.push_back({base::Severity::information, path_, line, 0, "", "", message, hint});
}

void ReadContext::warn_in(const std::string& file, const std::string& message, const std::string& hint, int line) {
  result_.diagnostics.push_back({base::Severity::warning, file, line, 0, "", "", message, hint});
}

std::string ReadContext::withdraw_syntax_error(int& out_line) {
  base::Diagnostics& all = result_.diagnostics;
  if (!not_understood_ || all.empty() || all.back().severity != base::Severity::error) return {};
  const std::string message = all.back().message;
  out_line = all.back().line;
  all.pop_back();
  return message;
}

bool ReadContext::allow_triangles(std::size_t total, int line) {
  if (total <= options_.max_triangles) return true;
  return fail("the mesh has " + std::to_string(total) + " triangles or more, at most " +
                  std::to_string(options_.max_triangles) + " are allowed",
              "reduce (decimate) the mesh", line);
}

bool ReadContext::allow_vertices(std::size_t total, int line) {
  if (total <= options_.max_vertices) return true;
  return fail("the mesh has " + std::to_string(total) + " vertices or more, at most " +
                  std::to_string(options_.max_vertices) + " are allowed",
              "reduce (decimate) the mesh", line);
}

std::string ReadContext::find_beside(const std::string& name) {
  if (name.empty() || name.size() > kLongestName || name.find('\0') != std::string::npos) return {};
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path folder(folder_), written(slashed);
  // As written; then, since exporters like to write absolute paths of their machine, by its last part beside the mesh,
  // and by its last two parts beside the folder (low_res/cube.mtl naming /home/somebody/scene/high_res/wood.png).
  const fs::path last_two = written.parent_path().filename() / written.filename();
  const fs::path candidates[] = {folder / written, folder / written.filename(), folder / ".." / last_two};
  for (const fs::path& candidate : candidates) {
    result_.depends_on.push_back(candidate.string());
    if (is_file(candidate)) return candidate.string();
  }
  return find_ignoring_case(folder.empty() ? fs::path(".") : folder, written.filename().string());
}

std::string ReadContext::find_texture(const std::string& name, const std::string& named_in, int line) {
  const auto known = textures_.find(name);
  if (known != textures_.end()) return known->second;
  if (textures_.size() > kMaxTextures) return {};
  if (textures_.size() == kMaxTextures) {
    textures_.emplace(name, "");
    warn_in(named_in, "more than " + std::to_string(kMaxTextures) + " textures are named; the rest is ignored",
            "use fewer textures", line);
    return {};
  }
  const std::string found = find_beside(name);
  textures_.emplace(name, found);
  if (found.empty()) {
    warn_in(named_in, "texture " + in_quotes(name, 200) + " was not found; the surface is drawn without it",
            "put it into the folder of the mesh", line);
  }
  return found;
}

bool ReadContext::read_beside(const std::string& name, std::string& out_path, std::string& out_bytes) {
  std::string why, hint;
  out_path = find_beside(name);
  return !out_path.empty() && read_whole_file(out_path, options_.max_file_bytes, out_bytes, why, hint);
}

bool read_whole_file(const std::string& path, std::size_t max_bytes, std::string& out_bytes, std::string& out_why,
                     std::string& out_hint) {
  out_bytes.clear();
  // O_NONBLOCK: opening a pipe must not wait for a writer.
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  struct stat status {};
  if (fd < 0 || ::fstat(fd, &status) != 0) {
    const int error = errno;
    if (fd >= 0) ::close(fd);
    const bool missing = error == ENOENT || error == ENOTDIR;
    out_why = missing ? "the file does not exist" : std::string("cannot read the file: ") + std::strerror(error);
    out_hint = missing ? "check the mesh name and the 'high resolution path' and 'low resolution path' of the model"
                       : "check the file and its permissions";
    return false;
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (!S_ISREG(status.st_mode)) {
    out_why = S_ISDIR(status.st_mode) ? "expected a mesh file, found a folder" : "expected a regular file";
    out_hint = "name a mesh file (docs/meshes.md lists the formats)";
  } else if (size > max_bytes) {
    out_why = "the file has " + mebibytes(size) + ", at most " + mebibytes(max_bytes) + " are read";
    out_hint = "reduce (decimate) the mesh or use a binary format";
  } else {
    out_bytes.resize(size);
    std::size_t done = 0;
    while (done < size) {
      const ssize_t got = ::read(fd, out_bytes.data() + done, size - done);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      done += static_cast<std::size_t>(got);
    }
    ::close(fd);
    if (done == size) return true;
    out_bytes.clear();
    out_why = "the file became shorter, or failed, while it was read";
    out_hint = "try again once it is written completely";
    return false;
  }
  ::close(fd);
  return false;
}

}  // namespace ambf::mesh
