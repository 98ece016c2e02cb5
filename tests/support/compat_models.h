// Where files made for the original simulator are: AMBF_COMPAT_DIR (models of its second generation) and
// AMBF_THIRD_GENERATION_DIR (a suite of its third), by default ../shared/compat and ../shared/third_generation beside
// the repository. They may be absent on somebody's machine, where tests that need them are skipped visibly, but never
// in CI, where those tests fail. One thread.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace ambf::compat {

inline std::filesystem::path shared_folder(const char* variable, const char* name) {
  if (const char* given = std::getenv(variable)) return given;
  return std::filesystem::path(AMBF_SOURCE_DIR) / ".." / "shared" / name;
}

inline std::filesystem::path folder() { return shared_folder("AMBF_COMPAT_DIR", "compat"); }
inline std::filesystem::path descriptions() { return folder() / "ambf_models/descriptions"; }
inline std::string model(const std::string& file) { return (descriptions() / "multi-bodies" / file).string(); }

inline std::filesystem::path third_generation() {
  return shared_folder("AMBF_THIRD_GENERATION_DIR", "third_generation");
}

// For the beginning of a test or of SetUp.
#define AMBF_NEEDS_FOLDER(path, variable)                                                  \
  if (!std::filesystem::exists(path)) {                                                    \
    const char* ci = std::getenv("CI");                                                    \
    if (ci != nullptr && *ci != '\0') FAIL() << "set " variable ": no models in " << path; \
    GTEST_SKIP() << "set " variable ": no models in " << path;                             \
  }
#define AMBF_NEEDS_COMPAT() AMBF_NEEDS_FOLDER(::ambf::compat::descriptions(), "AMBF_COMPAT_DIR")
#define AMBF_NEEDS_THIRD_GENERATION() \
  AMBF_NEEDS_FOLDER(::ambf::compat::third_generation() / "launch.yaml", "AMBF_THIRD_GENERATION_DIR")

}  // namespace ambf::compat
