#include <gtest/gtest.h>

#include "base/clock.h"
#include "ros_comm/endpoints/command_watch.h"
#include "ros_comm/limited_log.h"
#include "ros_comm/traffic.h"

namespace ambf::ros_comm {
namespace {

std::vector<std::string> texts(base::Log& log) {
  std::vector<std::string> out;
  base::LogRecord record;
  while (log.take(record)) out.push_back(record.text);
  return out;
}

TEST(LimitedLog, SaysAFewASecondAndHowManyItLeftOut) {
  base::Log log;
  LimitedLog limited(log, "refused commands", 3);
  std::int64_t now = 10 * base::kNanosecondsPerSecond;
  for (int i = 0; i < 1000; ++i) limited.warning("no " + std::to_string(i), now + i);
  EXPECT_EQ(texts(log), (std::vector<std::string>{"no 0", "no 1", "no 2"}));
  now += base::kNanosecondsPerSecond;
  limited.warning("later", now);
  EXPECT_EQ(texts(log), (std::vector<std::string>{"and 997 more refused commands", "later"}));
}

TEST(Traffic, CountsRefusalsByObjectAlsoThoseNotSaid) {
  base::Log log;
  Traffic traffic(log);
  for (int i = 0; i < 100; ++i) traffic.refuse("/a", "nan");
  traffic.refuse("/b", "inf");
  EXPECT_EQ(traffic.refused(), (std::map<std::string, std::uint64_t>{{"/a", 100}, {"/b", 1}}));
  const auto said = texts(log);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.front(), "command to '/a' refused: nan");
  EXPECT_LT(said.size(), 10u);
}

TEST(CommandWatch, SpeaksWhenACommandOfItsOwnEnds) {
  base::Log log;
  Traffic traffic(log);
  CommandWatch watch(traffic, "/box");
  watch.see(true);  // somebody else's command
  watch.see(false);
  EXPECT_TRUE(texts(log).empty());
  watch.commanded();
  watch.see(false);  // a frame of before
  watch.see(true);
  EXPECT_TRUE(texts(log).empty());
  watch.see(false);
  EXPECT_EQ(texts(log), (std::vector<std::string>{"WatchDog expired, Resetting \"/box\" command"}));
  watch.see(false);
  EXPECT_TRUE(texts(log).empty());
}

}  // namespace
}  // namespace ambf::ros_comm
