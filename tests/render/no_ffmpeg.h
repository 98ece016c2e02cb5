// Programs that are found instead of ffmpeg: none, or one of a test's own.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace ambf::render::testing {

// While it lives the program path holds nothing but `script` under ffmpeg's name; nothing at all when it is empty.
class NoFfmpeg {
 public:
  explicit NoFfmpeg(const std::string& script = "")
      : folder_(std::filesystem::temp_directory_path() / ("ambf_no_ffmpeg" + std::to_string(getpid()))),
        before_(std::getenv("PATH")) {
    std::filesystem::create_directories(folder_);
    if (!script.empty()) {
      const std::filesystem::path file = folder_ / "ffmpeg";
      std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
      std::filesystem::permissions(file, std::filesystem::perms::all);
    }
    setenv("PATH", folder_.c_str(), 1);
  }
  ~NoFfmpeg() {
    setenv("PATH", before_.c_str(), 1);
    std::filesystem::remove_all(folder_);
  }
  NoFfmpeg(const NoFfmpeg&) = delete;
  NoFfmpeg& operator=(const NoFfmpeg&) = delete;

 private:
  const std::filesystem::path folder_;
  const std::string before_;
};

}  // namespace ambf::render::testing
