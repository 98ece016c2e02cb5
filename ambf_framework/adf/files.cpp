#include "adf/detail/files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "adf/document.h"

namespace ambf::adf {

namespace fs = std::filesystem;

namespace {

bool is_file(const std::string& path) {
  // The system would stop reading a path at a null byte and look at another file.
  if (path.empty() || path.find('\0') != std::string::npos) return false;
  std::error_code problem;
  return fs::is_regular_file(path, problem);
}

std::string with_extension_case(const std::string& path, int (*change)(int)) {
  const std::size_t dot = path.rfind('.');
  const std::size_t slash = path.rfind('/');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return path;
  std::string out = path;
  std::transform(out.begin() + static_cast<std::ptrdiff_t>(dot), out.end(),
                 out.begin() + static_cast<std::ptrdiff_t>(dot),
                 [change](unsigned char c) { return static_cast<char>(change(c)); });
  return out;
}

}  // namespace

bool is_absolute(const std::string& path) { return path.starts_with('/'); }

std::string folder_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : file.substr(0, slash);
}

std::string file_name_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

std::string resolve(const std::string& folder, const std::string& path) {
  if (is_absolute(path)) return fs::path(path).lexically_normal().string();
  return (fs::path(folder) / path).lexically_normal().string();
}

std::string seen_from(const std::string& folder, const std::string& file) {
  std::error_code problem;
  const fs::path to = fs::weakly_canonical(fs::absolute(file, problem), problem);
  const fs::path from = fs::weakly_canonical(fs::absolute(folder, problem), problem);
  const std::string relative = problem ? "" : to.lexically_relative(from).string();
  return relative.empty() ? fs::absolute(file, problem).lexically_normal().string() : relative;
}

FileText read_text(const std::string& path) {
  std::error_code problem;
  if (path.find('\0') != std::string::npos || !fs::exists(path, problem)) return {std::nullopt, "no such file"};
  if (!fs::is_regular_file(path, problem)) return {std::nullopt, "not a file"};
  const std::uintmax_t size = fs::file_size(path, problem);
  if (problem) return {std::nullopt, "cannot be read: " + problem.message()};
  if (size > limits::kFileBytes)
    return {std::nullopt, "larger than " + std::to_string(limits::kFileBytes >> 20) + " MiB"};
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return {std::nullopt, "cannot be opened; are you allowed to read it?"};
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.bad()) return {std::nullopt, "reading it failed"};
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return {std::move(text), {}};
}

std::string find_file(const std::vector<std::string>& candidates) {
  for (const std::string& path : candidates) {
    if (is_file(path)) return path;
  }
  for (const std::string& path : candidates) {
    for (const auto change : {static_cast<int (*)(int)>(std::toupper), static_cast<int (*)(int)>(std::tolower)}) {
      const std::string other = with_extension_case(path, change);
      if (other != path && is_file(other)) return other;
    }
  }
  return {};
}

}  // namespace ambf::adf
