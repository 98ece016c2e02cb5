// docs/limits.md shows the numbers of the code.
#include "ambf_simulator/limits_page.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace ambf::simulator {
namespace {

TEST(Limits, DocumentationIsWhatTheCodeSays) {
  const std::string path = std::string(AMBF_SOURCE_DIR) + "/docs/limits.md";
  if (std::getenv("AMBF_UPDATE_DOCS") != nullptr) std::ofstream(path) << limits_as_markdown();
  std::stringstream written;
  written << std::ifstream(path).rdbuf();
  EXPECT_EQ(written.str(), limits_as_markdown()) << "renew it: AMBF_UPDATE_DOCS=1 build/bin/ambf_simulator_parts_tests";
}

TEST(Limits, EveryRowOfThePageIsPrintedToo) {
  const std::string page = limits_as_markdown(), printed = limits_as_text();
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0 || line.rfind("| what", 0) == 0) continue;
    const std::string what = line.substr(2, line.find(" | ") - 2);
    EXPECT_NE(printed.find("  " + what + ": "), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace ambf::simulator
