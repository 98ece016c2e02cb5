// URDF texts with every class of fault, and a good one with bytes changed at random, through live workers: each ends in
// a robot that can be simulated or in errors that name the file and what to do. A worker may die of its text; that is
// one error, too.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "adf/adf.h"

namespace ambf {
namespace {

const std::string kSeeds = std::string(AMBF_SOURCE_DIR) + "/tests/fuzz/corpus/urdf";

std::string text_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

bool finite(const math::Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Whether it became a robot.
bool run(const std::string& text, const std::string& what) {
  adf::Options options;
  options.look_for_files = false;
  const adf::ModelResult result = adf::parse_model(text, "robot.urdf", options);
  EXPECT_TRUE(result.model.has_value() || base::has_errors(result.diagnostics)) << what;
  for (const base::Diagnostic& d : result.diagnostics) {
    EXPECT_FALSE(d.message.empty()) << what;
    if (d.severity != base::Severity::error) continue;
    EXPECT_EQ(d.file, "robot.urdf") << what;
    EXPECT_FALSE(d.hint.empty()) << what << ": " << d.message;
  }
  if (!result.model) return false;
  for (const scene::Body& body : result.model->bodies) {
    EXPECT_TRUE(body.mass >= 0.0 && std::isfinite(body.mass)) << what;
    EXPECT_TRUE(finite(body.T_world_body.position)) << what;
  }
  for (const scene::Joint& joint : result.model->joints) {
    EXPECT_TRUE(finite(joint.parent_pivot) && finite(joint.child_pivot)) << what;
    EXPECT_NEAR(math::norm(joint.parent_axis), 1.0, 1e-9) << what;
    EXPECT_TRUE(!joint.limits || (*joint.limits)[0] <= (*joint.limits)[1]) << what;
  }
  return true;
}

TEST(FuzzUrdf, SeedsOfEachFaultEndInARobotOrAMessage) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSeeds)) {
    run(text_of(entry.path()), entry.path().stem().string());
    ++files;
  }
  EXPECT_GE(files, 40U);
  EXPECT_TRUE(run(text_of(kSeeds + "/good.urdf"), "good"));
}

TEST(FuzzUrdf, BytesChangedAtRandomEndInARobotOrAMessage) {
  const std::string good = text_of(kSeeds + "/good.urdf");
  const std::string pieces[] = {"nan",  "-1",  "1e999", "<", ">",       "/>",      "\"", "&#0;", "&lt;",
                                "<!--", "]]>", "<?",    " ", "</link>", "<link/>", "",   "\n"};
  std::mt19937 rng(7);
  int robots = 0;
  constexpr int kRounds = 150;
  for (int round = 0; round < kRounds; ++round) {
    std::string changed = good;
    for (auto changes = 1 + rng() % 3; changes > 0; --changes) {
      const std::size_t at = rng() % changed.size();
      switch (rng() % 3) {
        case 0: changed[at] = static_cast<char>(rng()); break;
        case 1: changed.replace(at, rng() % 4, pieces[rng() % std::size(pieces)]); break;
        default: changed.insert(at, changed.substr(rng() % changed.size(), rng() % 60)); break;
      }
    }
    robots += run(changed, "round " + std::to_string(round)) ? 1 : 0;
    if (testing::Test::HasFailure()) FAIL() << changed;
  }
  EXPECT_GT(robots, 0);
  EXPECT_LT(robots, kRounds);
}

TEST(FuzzUrdf, LongAndDeepTextsEnd) {
  for (const char* part : {"<a>", "<a ", "<!--", "<a b=\"", "<![CDATA[", "</a>", "&amp;", "<link name=\"a\"/>"}) {
    std::string text = "<robot name=\"r\">";
    for (int i = 0; i < 50'000; ++i) text += part;
    run(text, part);
  }
}

}  // namespace
}  // namespace ambf
