// Where the models made for the original simulator are: AMBF_COMPAT_DIR, by default ../shared/compat beside the repository. They may be
// absent on somebody's machine, where tests that need them are skipped visibly, but never in CI, where those tests fail. One thread.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace ambf::compat {

inline std::filesystem::path folder() {
  if (const char* given = std::getenv("AMBF_COMPAT_DIR")) return given;
  return std::filesystem::path(AMBF_SOURCE_DIR) / ".." / "shared" / "compat";
}
inline std::filesystem::path descriptions() { return folder() / "ambf_models/descriptions"; }
inline std::string model(const std::string& file) { return (descriptions() / "multi-bodies" / file).string(); }

// For the beginning of a test or of SetUp.
#define AMBF_NEEDS_COMPAT()                                                                                       \
  if (!std::filesystem::exists(::ambf::compat::descriptions())) {                                                 \
    const char* ci = std::getenv("CI");                                                                           \
    if (ci != nullptr && *ci != '\0') FAIL() << "set AMBF_COMPAT_DIR: no models in " << ::ambf::compat::folder(); \
    GTEST_SKIP() << "set AMBF_COMPAT_DIR: no models in " << ::ambf::compat::folder();                             \
  }

}  // namespace ambf::compat
