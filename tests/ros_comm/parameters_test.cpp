// Values of the parameter server: what is read, what is refused and why.
#include "ros_comm/endpoints/parameters.h"

#include <gtest/gtest.h>

namespace ambf::ros_comm {
namespace {

constexpr ParameterChoice kMode{"mode", {"MONO", "STEREO"}};
constexpr ParameterChoice kType{"type", {"SPOT", "POINT", "DIRECTIONAL"}};

TEST(ReadingParameters, TakesNumbersAndWordsThatAreGiven) {
  const Parameters changed{{"near", 0.5}, {"type", std::string("DIRECTIONAL")}};
  std::string problem;
  double near = 0.1, far = 10.0;
  int type = 0, mode = 1;
  read_number(changed, "near", near, problem);
  read_number(changed, "far", far, problem);
  read_choice(changed, kType, type, problem);
  read_choice(changed, kMode, mode, problem);
  EXPECT_EQ(problem, "");
  EXPECT_EQ(near, 0.5);
  EXPECT_EQ(far, 10.0);
  EXPECT_EQ(type, 2);
  EXPECT_EQ(mode, 1);
}

TEST(ReadingParameters, NamesTheFirstProblemAndTheChoices) {
  const Parameters changed{{"near", std::string("close")}, {"mode", 2.0}, {"type", std::string("MOON")}};
  double near = 0.1;
  int mode = 0, type = 0;
  std::string problem;
  read_choice(changed, kMode, mode, problem);
  EXPECT_EQ(problem, "mode must be MONO or STEREO");
  read_number(changed, "near", near, problem);
  EXPECT_EQ(problem, "mode must be MONO or STEREO");
  problem.clear();
  read_number(changed, "near", near, problem);
  EXPECT_EQ(problem, "near must be a number");
  problem.clear();
  read_choice(changed, kType, type, problem);
  EXPECT_EQ(problem, "type must be SPOT, POINT or DIRECTIONAL");
  EXPECT_EQ(near, 0.1);
  EXPECT_EQ(mode, 0);
  EXPECT_EQ(type, 0);
}

TEST(ComparingParameters, AllowsWhatIsLostInText) {
  EXPECT_TRUE(same(0.1 + 0.2, 0.3));
  EXPECT_FALSE(same(0.1, 0.1001));
  EXPECT_FALSE(same(1.0, std::string("1.0")));
}

}  // namespace
}  // namespace ambf::ros_comm
