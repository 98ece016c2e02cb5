// Paths of ADF files (ADF 1.7), and reading text without being caught by pipes, devices or huge files. Reads the file
// system; never throws.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ambf::adf {

// The folder of a file, "." for a bare name.
std::string folder_of(const std::string& file);
std::string file_name_of(const std::string& path);
// `path` below `folder`; an absolute path stays what it is.
std::string resolve(const std::string& folder, const std::string& path);
// The relative path that leads from a folder to a file; where none does, the absolute one.
std::string seen_from(const std::string& folder, const std::string& file);
bool is_absolute(const std::string& path);

struct FileText {
  std::optional<std::string> text;
  std::string problem;  // why there is none
};
FileText read_text(const std::string& path);

// The first candidate that is a file; its extension may be written in another case than the file has it. "" when there
// is none.
std::string find_file(const std::vector<std::string>& candidates);

}  // namespace ambf::adf
