// The log of tests' simulations: whatever a test does not name fails it, and so does what it names in vain.
#include "tests/support/judged_log.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

namespace ambf {
namespace {

TEST(JudgedLog, FailsByAnUnexpectedWarningOrError) {
  EXPECT_NONFATAL_FAILURE(JudgedLog().warning("gains are cut"), "unexpected in the log: gains are cut");
  EXPECT_NONFATAL_FAILURE(JudgedLog().error("no such file"), "unexpected in the log: no such file");
  JudgedLog().info("all is well");
}

TEST(JudgedLog, FailsByTheLackOfAnExpectedWarning) {
  EXPECT_NONFATAL_FAILURE(JudgedLog().expect_warning("gains"), "expected in the log: gains");
  JudgedLog log;
  log.expect_warning("gains");
  log.allow("never said");
  log.warning("gains are cut");
  log.warning("gains are cut");
}

}  // namespace
}  // namespace ambf
