// The panel's topics: a program beside the simulator that is talked to, and may be missing, broken, dying or silent. A small shell script stands
// in for `ambf-cli serve`; tests/tools/test_topics.py has the real one.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "ambf_simulator/topic_helper.h"
#include "base/log_drain.h"

namespace ambf::simulator {
namespace {

namespace fs = std::filesystem;
using Stage = render::TopicView::Stage;

bool eventually(const std::function<bool()>& good) {
  for (int i = 0; i < 4000; ++i) {
    if (good()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

// Says that all is well, then answers every request with its own line; writes down what it heard and who it is.
constexpr const char* kGood = R"(#!/bin/sh
here=$(dirname "$0")
echo $$ > "$here/pid"
echo "$@" > "$here/arguments"
echo '{"event": "master", "alive": true, "uri": "http://m"}'
echo '{"event": "list", "topics": [["/a", "std_msgs/String", 2, 1, true]], "services": [["/s", "x/Y", false]]}'
while read -r line; do
  printf '%s\n' "$line" >> "$here/heard"
  case "$line" in
    *'"watch","topics":["/a"]'*)
      echo '{"event": "message", "topic": "/a", "type": "std_msgs/String", "count": 3, "bytes": 9, "rate": 2.5,
"rows": [["data", "hi"], ["deep", "", [["inner", "1"], ["more", "2"]]], ["last", "x"]]}' | tr -d '\n'; echo ;;
    *'"publish"'*)
      id=${line#*'"id":'}; id=${id%%,*}
      echo '{"event": "publishing", "topics": [{"topic": "/a", "rate": 10, "count": 4}]}'
      echo "{\"event\": \"answer\", \"id\": $id, \"text\": \"published\"}" ;;
    *'"call"'*)
      id=${line#*'"id":'}; id=${id%%,*}
      echo "{\"event\": \"answer\", \"id\": $id, \"error\": \"no such service\"}" ;;
  esac
done
)";
constexpr const char* kBroken = "#!/bin/sh\necho 'a warning' >&2\necho 'ambf-cli: No module named rospy' >&2\nexit 3\n";
constexpr const char* kDeaf = R"(#!/bin/sh
trap '' INT TERM
echo $$ > "$(dirname "$0")/pid"
echo '{"event": "master", "alive": false, "uri": "http://m"}'
while true; do sleep 0.05; done
)";
// Begins well and ends after a moment, writing down each beginning in ns.
constexpr const char* kMortal = R"(#!/bin/sh
date +%s%N >> "$(dirname "$0")/begun"
echo '{"event": "master", "alive": true, "uri": "http://m"}'
sleep 0.1
exit 1
)";
constexpr const char* kNonsense = R"(#!/bin/sh
echo 'Traceback'
echo '{"event": "list", "topics": [["/a"]]}'
echo '{"event": 5}'
echo '[1, 2'
echo '{"event": "answer", "id": 77, "text": "nobody asked"}'
echo '{"event": "master", "alive": true, "uri": "http://m"}'
while read -r line; do :; done
)";

class TopicHelperTest : public ::testing::Test {
 protected:
  TopicHelperTest() { fs::create_directories(folder); }
  ~TopicHelperTest() override { fs::remove_all(folder); }

  TopicHelperOptions with(const char* script) const {
    const fs::path program = folder / "ambf-cli";
    std::ofstream(program) << script;
    fs::permissions(program, fs::perms::owner_all);
    return {"", {program.string()}, 0.05, 1.0};
  }
  pid_t pid() const {
    pid_t found = 0;
    eventually([&] { return static_cast<bool>(std::ifstream(folder / "pid") >> found); });
    return found;
  }
  std::string text_of(const std::string& file) const {
    std::ifstream in(folder / file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // When programs that write it down began, in s.
  std::vector<double> begun() const {
    std::ifstream in(folder / "begun");
    std::vector<double> found;
    for (double ns = 0.0; in >> ns;) found.push_back(1e-9 * ns);
    return found;
  }
  static int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  }
  static bool runs(const TopicHelper& topics) { return topics.view()->stage == Stage::running; }
  static bool gone(pid_t pid) { return kill(pid, 0) != 0 && errno == ESRCH; }
  // The one answer that comes.
  static render::TopicAnswer answer(TopicHelper& topics) {
    render::TopicAnswer found;
    EXPECT_TRUE(eventually([&] {
      for (render::TopicAnswer& each : topics.take_answers()) found = std::move(each);
      return found.id != 0;
    }));
    return found;
  }

  const fs::path folder = fs::temp_directory_path() / ("ambf_topic_helper" + std::to_string(getpid()));
  base::Log log;
};

TEST_F(TopicHelperTest, NothingIsStartedBeforeSomebodyLooks) {
  TopicHelper topics(with(kGood), log);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(topics.view()->stage, Stage::off);
  EXPECT_FALSE(fs::exists(folder / "pid"));
  topics.look(true);
  EXPECT_TRUE(eventually([&] { return runs(topics) && topics.view()->list->size() == 2; }));
  EXPECT_EQ(text_of("arguments"), "serve --simulator " + std::to_string(getpid()) + "\n");
  const render::TopicInfo topic = topics.view()->list->at(0), service = topics.view()->list->at(1);
  EXPECT_EQ(topic.name + " " + topic.type, "/a std_msgs/String");
  EXPECT_TRUE(topic.ours && !topic.service && topic.publishers == 2 && topic.listeners == 1);
  EXPECT_EQ(service.name + " " + service.type, "/s x/Y");
  EXPECT_TRUE(!service.ours && service.service);
}

TEST_F(TopicHelperTest, AWatchedMessageComesAsRows) {
  TopicHelper topics(with(kGood), log);
  topics.look(true);
  topics.watch("/a");
  ASSERT_TRUE(eventually([&] { return topics.view()->message != nullptr; }));
  const auto view = topics.view();
  EXPECT_EQ(view->message->count, 3u);
  EXPECT_EQ(view->message->rate_hz, 2.5);
  std::string rows;
  for (const render::MessageRow& row : view->message->rows) {
    rows += std::string(static_cast<std::size_t>(row.depth), '>') + (row.opens ? "+" : "") + row.name + "=" +
            row.value + " ";
  }
  EXPECT_EQ(rows, "data=hi +deep= >inner=1 >more=2 last=x ");
  topics.watch("");
  EXPECT_EQ(topics.view()->message, nullptr);
  EXPECT_TRUE(eventually([&] { return text_of("heard").find(R"({"do":"watch","topics":[]})") != std::string::npos; }));
}

TEST_F(TopicHelperTest, RequestsAreAnsweredUnderTheirNumber) {
  TopicHelper topics(with(kGood), log);
  const std::uint64_t first = topics.publish("/a", "std_msgs/String", "data: \"q\\n\"\nx: \xff", 10.0);
  render::TopicAnswer published = answer(topics);
  EXPECT_EQ(published.id, first);
  EXPECT_TRUE(published.good);
  EXPECT_EQ(published.text, "published");
  ASSERT_EQ(topics.view()->published.size(), 1u);
  EXPECT_EQ(topics.view()->published[0].count, 4u);
  const std::uint64_t second = topics.call("/s", "", "");
  const render::TopicAnswer refused = answer(topics);
  EXPECT_NE(second, first);
  EXPECT_EQ(refused.id, second);
  EXPECT_FALSE(refused.good);
  EXPECT_EQ(refused.text, "no such service");
  const std::string heard = text_of("heard");
  EXPECT_NE(heard.find(R"("text":"data: \"q\\n\"\nx: \ufffd")"), std::string::npos) << heard;
}

TEST_F(TopicHelperTest, AKilledProgramIsSaidStartedAgainAndGoesOnWatching) {
  TopicHelper topics(with(kGood), log);
  topics.look(true);
  topics.watch("/a");
  topics.publish("/a", "", "", 10.0);
  ASSERT_TRUE(eventually([&] { return topics.view()->message != nullptr && !topics.view()->published.empty(); }));
  const pid_t first = pid();
  fs::remove(folder / "pid");
  std::string problem;
  std::uint64_t unanswered = topics.ask_template({});  // the script does not know it
  EXPECT_EQ(answer(topics).text, "published");
  kill(first, SIGKILL);
  ASSERT_TRUE(eventually([&] { return !(problem = topics.view()->problem).empty(); }));
  ASSERT_TRUE(eventually([&] { return runs(topics); }));
  ASSERT_NE(pid(), first);
  EXPECT_TRUE(eventually([&] {
    const std::string heard = text_of("heard");
    return heard.find(R"("topics":["/a"])") != heard.rfind(R"("topics":["/a"])");
  })) << "told again what to watch";
  EXPECT_EQ(problem, "ambf-cli was ended by signal 9; nothing is published at a rate any more");
  EXPECT_EQ(topics.view()->problem, "") << "it runs again";
  EXPECT_TRUE(topics.view()->published.empty());
  EXPECT_TRUE(gone(first));
  const render::TopicAnswer given_up = answer(topics);
  EXPECT_EQ(given_up.id, unanswered);
  EXPECT_EQ(given_up.text, "ambf-cli was ended by signal 9");
}

TEST_F(TopicHelperTest, WhatDiesAgainAndAgainIsStartedEverMoreSeldomAndSaidOnce) {
  TopicHelperOptions options = with(kMortal);
  options.longest_pause_s = 0.4;
  std::string told;
  {
    base::LogDrain drain(log, [&](const base::LogLine& line) { told += line.text + "\n"; });
    TopicHelper topics(options, log);
    topics.look(true);
    std::shared_ptr<const render::TopicView> view;
    ASSERT_TRUE(eventually([&] {
      view = topics.view();
      return begun().size() >= 4 && view->stage == Stage::failed;
    }));
    EXPECT_NE(view->problem.find("ambf-cli ended with 1. It ended "), std::string::npos) << view->problem;
    EXPECT_NE(view->problem.find(" times, and is started again after 1 s"), std::string::npos) << view->problem;
    const std::uint64_t asked = topics.call("/s", "", "");
    EXPECT_EQ(answer(topics).id, asked) << "nobody waits through a pause";
    ASSERT_TRUE(eventually([&] { return begun().size() >= 6; }));
  }
  const std::vector<double> times = begun();
  const double pauses_s[] = {0.05, 0.1, 0.2, 0.4, 0.4};  // besides the 0.1 s that it lived
  for (std::size_t i = 0; i < 5; ++i) EXPECT_GT(times[i + 1] - times[i], 0.1 + pauses_s[i]) << i;
  EXPECT_EQ(count(told, "ambf-cli ended with 1"), 2) << told;
  EXPECT_EQ(count(told, "ever more seldom, at last every 0.4 s"), 1) << told;
}

TEST_F(TopicHelperTest, TryAgainCutsAPauseShort) {
  TopicHelperOptions options = with(kMortal);
  options.longest_pause_s = options.pause_s = 60.0;
  TopicHelper topics(options, log);
  topics.look(true);
  ASSERT_TRUE(eventually([&] { return topics.view()->problem == "ambf-cli ended with 1"; }));
  with(kGood);  // mended
  topics.retry();
  EXPECT_TRUE(eventually([&] { return runs(topics) && topics.view()->problem.empty(); }));
}

TEST_F(TopicHelperTest, WhatRanWellForAWhileIsStartedAgainSoon) {
  TopicHelperOptions options = with(kMortal);
  options.longest_pause_s = 60.0;
  options.pause_s = 0.2;
  options.well_s = 0.02;
  TopicHelper topics(options, log);
  topics.look(true);
  EXPECT_TRUE(eventually([&] {
    EXPECT_NE(topics.view()->stage, Stage::failed);
    return begun().size() >= 6;
  })) << "at once, not after 6 s in pauses";
}

TEST_F(TopicHelperTest, WhatCannotBeginIsSaidByItsLastLineAndTriedAgainOnDemandOnly) {
  TopicHelper topics(with(kBroken), log);
  topics.look(true);
  ASSERT_TRUE(eventually([&] { return topics.view()->stage == Stage::failed; }));
  EXPECT_EQ(topics.view()->problem, "ambf-cli ended with 3: ambf-cli: No module named rospy");
  topics.call("/s", "", "");
  EXPECT_EQ(answer(topics).text, topics.view()->problem);
  with(kGood);  // mended
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(topics.view()->stage, Stage::failed);
  topics.retry();
  EXPECT_TRUE(eventually([&] { return runs(topics); }));
  EXPECT_EQ(topics.view()->problem, "");
}

TEST_F(TopicHelperTest, AMissingProgramIsSaidWithWhatToDo) {
  TopicHelper topics({"", {(folder / "tree/.venv/bin/ambf-cli").string()}}, log);
  topics.look(true);
  ASSERT_TRUE(eventually([&] { return topics.view()->stage == Stage::failed; }));
  EXPECT_NE(topics.view()->problem.find("there is no ambf-cli on the PATH"), std::string::npos);
  EXPECT_NE(topics.view()->problem.find("./dev deps"), std::string::npos);
}

TEST_F(TopicHelperTest, WithoutRosNothingIsStartedAndRequestsAreRefused) {
  TopicHelperOptions options = with(kGood);
  options.unavailable = "no ROS here";
  TopicHelper topics(options, log);
  topics.look(true);
  topics.publish("/a", "", "", 0.0);
  EXPECT_EQ(answer(topics).text, "no ROS here");
  EXPECT_FALSE(fs::exists(folder / "pid"));
}

TEST_F(TopicHelperTest, NonsenseIsPassedOver) {
  TopicHelper topics(with(kNonsense), log);
  topics.look(true);
  EXPECT_TRUE(eventually([&] { return runs(topics); }));
  EXPECT_TRUE(topics.view()->list->empty());
  EXPECT_TRUE(topics.take_answers().empty()) << "nobody asked";
}

TEST_F(TopicHelperTest, ItEndsWithTheSimulator) {
  pid_t program = 0;
  {
    TopicHelper topics(with(kGood), log);
    topics.look(true);
    program = pid();
  }
  EXPECT_TRUE(gone(program));
}

TEST_F(TopicHelperTest, AProgramThatDoesNotEndIsKilled) {
  pid_t program = 0;
  {
    TopicHelper topics(with(kDeaf), log);
    topics.look(true);
    program = pid();
    EXPECT_TRUE(eventually([&] { return topics.view()->problem == "no ROS master answers at http://m"; }));
  }
  EXPECT_TRUE(gone(program));
}

TEST_F(TopicHelperTest, AProgramThatReadsNothingHoldsUpNobody) {
  TopicHelper topics(with(kDeaf), log);
  topics.look(true);
  ASSERT_TRUE(eventually([&] { return runs(topics); }));
  const std::string text(1 << 20, 'x');
  for (int i = 0; i < 5; ++i) topics.publish("/a", "", text, 0.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(pid(), SIGKILL);
  int given_up = 0;
  EXPECT_TRUE(eventually([&] { return (given_up += static_cast<int>(topics.take_answers().size())) == 5; }));
}

}  // namespace
}  // namespace ambf::simulator
