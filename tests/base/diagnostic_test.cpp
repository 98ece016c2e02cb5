// The form of a finding: what editors and users read.
#include "base/diagnostic.h"

#include <gtest/gtest.h>

namespace ambf::base {
namespace {

TEST(Diagnostic, NamesPlaceSeverityBlockKeyMessageAndHint) {
  const Diagnostic d{Severity::warning, "arm.yaml", 12, 3, "BODY Link1", "mas", "unknown key", "did you mean mass?"};
  EXPECT_EQ(to_string(d), "arm.yaml:12:3: warning: [BODY Link1: mas] unknown key (did you mean mass?)");
}

TEST(Diagnostic, LeavesOutWhatIsUnknown) {
  Diagnostic d;
  d.message = "no such file";
  EXPECT_EQ(to_string(d), "error: no such file");
  d.file = "a.yaml";
  d.block = "BODY B";
  EXPECT_EQ(to_string(d), "a.yaml: error: [BODY B] no such file");
  d.line = 4;
  d.severity = Severity::information;
  EXPECT_EQ(to_string(d), "a.yaml:4: info: [BODY B] no such file");
}

TEST(Diagnostic, TellsErrorsFromWarnings) {
  Diagnostics list(1);
  list[0].severity = Severity::information;
  EXPECT_FALSE(has_errors(list));
  EXPECT_FALSE(has_warnings(list));
  list.emplace_back();
  list.back().severity = Severity::warning;
  EXPECT_FALSE(has_errors(list));
  EXPECT_TRUE(has_warnings(list));
  list.emplace_back();
  EXPECT_TRUE(has_errors(list));
}

}  // namespace
}  // namespace ambf::base
