#include <gtest/gtest.h>

#include "base/clock.h"
#include "ros_comm/endpoints/command_input.h"
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
  LimitedLog limited(log, base::Severity::warning, "refused commands", 3);
  std::int64_t now = 10 * base::kNanosecondsPerSecond;
  for (int i = 0; i < 1000; ++i) limited.add("no " + std::to_string(i), now + i);
  EXPECT_EQ(texts(log), (std::vector<std::string>{"no 0", "no 1", "no 2"}));
  now += base::kNanosecondsPerSecond;
  limited.add("later", now);
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

// Counts what is posted and refused; where the object is gone there is no port.
class CountingAbility final : public state::CommandAbility {
 public:
  std::unique_ptr<state::CommandPort> bind(state::ObjectId, state::Source) override {
    return gone ? nullptr : std::make_unique<Port>(*this);
  }
  void count_refused_command(state::ObjectId object) override { refused.push_back(object); }
  void push(state::ObjectId, const state::Push&, state::Completion) override {}

  bool gone = false;
  int posted = 0;
  std::vector<state::ObjectId> refused;

 private:
  class Port final : public state::CommandPort {
   public:
    explicit Port(CountingAbility& owner) : owner_(owner) {}
    void post(const state::Command&) override { ++owner_.posted; }
    void post(const state::Command&, std::int64_t) override { ++owner_.posted; }
    void keep_alive() override {}
    void hold() override {}
    void release() override {}

   private:
    CountingAbility& owner_;
  };
};

state::ObjectInfo box() {
  state::ObjectInfo object;
  object.name = "/box";
  object.id = {3, 1};
  return object;
}

TEST(CommandInput, LogsTheEndOfItsOwnCommandsOnly) {
  base::Log log;
  Traffic traffic(log);
  CountingAbility ability;
  CommandInput input(traffic, ability, box());
  input.watch(true);  // the command of another source
  input.watch(false);
  EXPECT_TRUE(texts(log).empty());
  input.post(state::PoseCommand{});
  input.watch(false);  // a frame from before the command
  input.watch(true);
  EXPECT_TRUE(texts(log).empty());
  input.watch(false);
  EXPECT_EQ(texts(log), (std::vector<std::string>{"the command of '/box' has ended (nothing for 0.5 s)"}));
  input.watch(false);
  EXPECT_TRUE(texts(log).empty());
}

TEST(CommandInput, CountsPostedAndRefusedCommands) {
  base::Log log;
  Traffic traffic(log);
  CountingAbility ability;
  CommandInput input(traffic, ability, box());
  input.post(state::PoseCommand{});
  input.refuse("nan");
  EXPECT_EQ(ability.posted, 1);
  EXPECT_EQ(traffic.accepted, 1u);
  EXPECT_EQ(ability.refused, std::vector<state::ObjectId>{box().id});
  EXPECT_EQ(traffic.refused(), (std::map<std::string, std::uint64_t>{{"/box", 1}}));
}

TEST(CommandInput, DropsCommandsToAnObjectThatIsGone) {
  base::Log log;
  Traffic traffic(log);
  CountingAbility ability;
  ability.gone = true;
  CommandInput input(traffic, ability, box());
  input.post(state::PoseCommand{});
  EXPECT_EQ(ability.posted, 0);
  EXPECT_EQ(traffic.accepted, 0u);
}

}  // namespace
}  // namespace ambf::ros_comm
