// Topics and services in the panel: what it asks of the program around the windows, and what it shows of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "panel_rig.h"
#include "render/panel/detail/topic_desk.h"
#include "render/window/topic_access.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

class FakeTopics final : public TopicAccess {
 public:
  FakeTopics() {
    const std::vector<TopicInfo> list = {
        {"/ambf/env/box/Command", "ambf_msgs/RigidBodyCmd", false, true, 0, 1},
        {"/ambf/env/box/State", "ambf_msgs/RigidBodyState", false, true, 1, 0},
        {"/other/State", "std_msgs/String", false, false, 1, 2},
        {"/ambf/env/World/Step", "ambf_msgs/Step", true, true, 0, 0},
        {"/other/get", "other_msgs/Get", true, false, 0, 0},
    };
    now.stage = TopicView::Stage::running;
    now.list = std::make_shared<const std::vector<TopicInfo>>(list);
  }
  std::string unavailable() const override { return missing; }
  void look(bool on) override { looked = on; }
  void retry() override { ++retried; }
  std::shared_ptr<const TopicView> view() const override { return std::make_shared<const TopicView>(now); }
  void watch(const std::string& topic) override { watched = topic; }
  std::uint64_t ask_template(const TopicInfo& of) override { return asked("template " + of.name); }
  std::uint64_t publish(const std::string& topic, const std::string& type, const std::string& text,
                        double rate_hz) override {
    return asked("publish " + topic + " " + type + " " + text + " " + std::to_string(static_cast<int>(rate_hz)));
  }
  std::uint64_t stop_publishing(const std::string& topic) override { return asked("stop " + topic); }
  std::uint64_t call(const std::string& service, const std::string& type, const std::string& text) override {
    return asked("call " + service + " " + type + " " + text);
  }
  std::vector<TopicAnswer> take_answers() override { return std::exchange(answers, {}); }

  std::uint64_t asked(const std::string& what) {
    requests.push_back(what);
    return requests.size();
  }
  int count(const std::string& what) const {
    return static_cast<int>(std::count(requests.begin(), requests.end(), what));
  }
  void answer(bool good, const std::string& text, std::vector<MessageRow> rows = {}) {  // the last request
    answers.push_back({requests.size(), good, text, std::move(rows)});
  }
  void send(const std::string& topic) {
    auto message = std::make_shared<WatchedMessage>();
    message->topic = topic;
    message->type = "ambf_msgs/RigidBodyState";
    message->count = 5;
    message->came_ns = base::steady_ns();
    message->rows = {{0, false, "name", "box"},
                     {0, true, "pose", ""},
                     {1, false, "position", "x 1  y 2  z 3"},
                     {0, true, "joint_positions", "0.1, 0.2"},
                     {1, false, "[0]", "0.1"},
                     {1, false, "[1]", "0.2"},
                     {0, false, "last", "7"}};
    now.message = message;
  }

  std::string missing, watched;
  TopicView now;
  std::vector<std::string> requests;
  std::vector<TopicAnswer> answers;
  bool looked = false;
  int retried = 0;
};

struct PanelTopics : ::testing::Test {
  FakeTopics topics;
  PanelRig rig{"", 1600, 2600, 2.0, nullptr, "", &topics};
  TopicDesk& desk = rig.model.topics;

  double top(const std::string& widget) const { return rig.ui.place(widget)->top; }
  void choose(const std::string& name) {
    rig.click("topics/" + name);
    rig.pictures(2);
  }
};

TEST_F(PanelTopics, NobodyIsAskedAnythingBeforeTheTabIsSeenNorLongAfter) {
  rig.pictures(3);
  EXPECT_FALSE(topics.looked);
  rig.tab("Topics");
  rig.pictures(2);
  EXPECT_TRUE(topics.looked);
  choose("/ambf/env/box/State");
  EXPECT_EQ(topics.watched, "/ambf/env/box/State");
  rig.tab("Log");
  rig.pictures(150);
  EXPECT_FALSE(topics.looked);
  EXPECT_EQ(topics.watched, "");
}

TEST_F(PanelTopics, AreListedOursFirstAndFoundByWordsTypeAndKind) {
  rig.tab("Topics");
  rig.pictures(2);
  ASSERT_TRUE(rig.shown("topics//other/get"));
  EXPECT_LT(top("topics//ambf/env/box/State"), top("topics//ambf/env/World/Step"));
  EXPECT_LT(top("topics//ambf/env/World/Step"), top("topics//other/State"));
  EXPECT_LT(top("topics//other/State"), top("topics//other/get"));
  rig.click("topics/search");
  rig.type("other string");
  EXPECT_TRUE(rig.shown("topics//other/State")) << "by a word of its name and one of its type";
  EXPECT_FALSE(rig.shown("topics//other/get"));
  EXPECT_FALSE(rig.shown("topics//ambf/env/box/State"));
  for (int i = 0; i < 12; ++i) rig.key("Backspace");
  rig.click("topics/services", 0.1);
  EXPECT_FALSE(rig.shown("topics//other/get"));
  EXPECT_TRUE(rig.shown("topics//other/State"));
  rig.click("topics/others", 0.1);
  EXPECT_FALSE(rig.shown("topics//other/State"));
  rig.click("topics/services", 0.1);
  rig.click("topics/topics", 0.1);
  EXPECT_TRUE(rig.shown("topics//ambf/env/World/Step"));
  EXPECT_FALSE(rig.shown("topics//ambf/env/box/State"));
}

TEST_F(PanelTopics, AListThatComesWhileNobodyLooksIsFilteredAnewWhereverItLies) {
  rig.tab("Topics");
  rig.pictures(2);
  ASSERT_TRUE(rig.shown("topics//other/get"));
  rig.tab("Log");
  const auto* const seen = topics.now.list.get();
  topics.now.list = std::make_shared<const std::vector<TopicInfo>>();
  rig.pictures(2);  // the panel has let go of the old one, whose place is free
  std::vector<std::shared_ptr<const std::vector<TopicInfo>>> tried;
  for (int i = 0; i < 100 && (tried.empty() || tried.back().get() != seen); ++i)
    tried.push_back(
        std::make_shared<const std::vector<TopicInfo>>(1, TopicInfo{"/only", "std_msgs/Empty", true, true, 0, 0}));
  topics.now.list = tried.back();
  rig.tab("Topics");
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("topics//only"));
  EXPECT_FALSE(rig.shown("topics//other/get"));
}

TEST_F(PanelTopics, AMessageIsATreeWhoseArraysAreFolded) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/State");
  EXPECT_FALSE(rig.shown("topics/message"));
  topics.send("/other/State");
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("topics/message")) << "of another topic";
  topics.send("/ambf/env/box/State");
  rig.pictures(2);
  ASSERT_TRUE(rig.shown("topics/message"));
  const double line = top("message/pose") - top("message/name");
  EXPECT_NEAR(top("message/joint_positions") - top("message/pose"), 2.0 * line, 2.0) << "unfolded";
  EXPECT_NEAR(top("message/last") - top("message/joint_positions"), line, 2.0) << "folded";
  rig.click("message/joint_positions", 0.03);
  EXPECT_NEAR(top("message/last") - top("message/joint_positions"), 3.0 * line, 2.0);
  rig.click("message/pose", 0.03);
  EXPECT_NEAR(top("message/joint_positions") - top("message/pose"), line, 2.0);
  rig.click("message/last");
  EXPECT_EQ(rig.clipboard, "7");
}

TEST_F(PanelTopics, ATypeWithoutFieldsIsSaidToHaveNothingToFillIn) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/Command");
  EXPECT_FALSE(rig.shown("topics/no fields")) << "not known yet";
  topics.answer(true, "");
  rig.pictures(3);
  EXPECT_TRUE(rig.shown("topics/no fields"));
}

TEST_F(PanelTopics, AMessageIsWrittenFromItsTemplateAndPublished) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/Command");
  EXPECT_EQ(topics.count("template /ambf/env/box/Command"), 1) << "asked for by itself, once";
  topics.answer(true, "x: 0");
  rig.pictures(3);
  EXPECT_EQ(desk.draft().text, "x: 0");
  EXPECT_EQ(topics.requests.size(), 1u);
  rig.click("topics/text");
  rig.key("End");
  rig.type("5");
  rig.click("topics/publish");
  EXPECT_EQ(topics.requests.back(), "publish /ambf/env/box/Command ambf_msgs/RigidBodyCmd x: 05 0");
  EXPECT_EQ(desk.draft().sent.state, TopicDesk::Outcome::State::waiting);
  topics.answer(false, "field x must be float");
  rig.pictures(2);
  EXPECT_EQ(desk.draft().sent.state, TopicDesk::Outcome::State::bad);
  EXPECT_EQ(desk.draft().sent.text, "field x must be float");
  EXPECT_TRUE(rig.shown("topics/outcome"));
  choose("/other/State");
  choose("/ambf/env/box/Command");
  EXPECT_EQ(desk.draft().text, "x: 05") << "kept while another was chosen";
  rig.click("topics/template");
  topics.answer(true, "x: 0");
  rig.pictures(2);
  EXPECT_EQ(desk.draft().text, "x: 0");
}

TEST_F(PanelTopics, ATemplateThatComesLateDoesNotReplaceWhatIsWritten) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/Command");
  rig.click("topics/text");
  rig.type("y");
  topics.answer(true, "x: 0");
  rig.pictures(2);
  EXPECT_EQ(desk.draft().text, "y");
}

TEST_F(PanelTopics, CtrlEnterInTheTextPublishes) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/Command");
  topics.answer(true, "x: 0");
  rig.pictures(2);
  rig.click("topics/text");
  rig.key("Enter", {.control = true});
  rig.pictures(2);
  EXPECT_EQ(topics.count("publish /ambf/env/box/Command ambf_msgs/RigidBodyCmd x: 0 0"), 1);
  // All between two pictures, where pictures are slow.
  rig.click("topics/text");
  const Modifiers control{.control = true};
  for (const bool released : {false, true}) rig.put(KeyInput{"A", control, false, released});
  for (const char c : {'y', 'z'}) {
    const std::string name(1, static_cast<char>(c - 'a' + 'A'));
    rig.put(KeyInput{name, {}, false, false});
    rig.put(TextInput{static_cast<char32_t>(c)});
    rig.put(KeyInput{name, {}, false, true});
  }
  for (const bool released : {false, true}) rig.put(KeyInput{"Enter", control, false, released});
  rig.pictures(6);
  EXPECT_EQ(topics.requests.back(), "publish /ambf/env/box/Command ambf_msgs/RigidBodyCmd yz 0");
}

TEST_F(PanelTopics, PublishingAtARateIsShownAndEnded) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/Command");
  rig.enter("topics/rate", "50");
  rig.click("topics/repeat");
  EXPECT_EQ(topics.requests.back(), "publish /ambf/env/box/Command ambf_msgs/RigidBodyCmd  50");
  EXPECT_FALSE(rig.shown("topics/stop"));
  topics.now.published = {{"/ambf/env/box/Command", 50.0, 12}};
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("topics/repeat"));
  rig.click("topics/stop");
  EXPECT_EQ(topics.requests.back(), "stop /ambf/env/box/Command");
}

TEST_F(PanelTopics, WhatIsPublishedIsEndedEvenWhenNobodyElseKnowsTheTopicAnyMore) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/Command");
  topics.now.published = {{"/ambf/env/box/Command", 50.0, 12}, {"/other/gone", 10.0, 3}};
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("topics/stop /ambf/env/box/Command")) << "it has its own";
  rig.click("topics/stop /other/gone");  // behind another choice
  EXPECT_EQ(topics.requests.back(), "stop /other/gone");
  topics.now.list = std::make_shared<const std::vector<TopicInfo>>();  // its model was unloaded
  rig.pictures(2);
  rig.click("topics/stop /ambf/env/box/Command");
  EXPECT_EQ(topics.requests.back(), "stop /ambf/env/box/Command");
}

TEST_F(PanelTopics, AServiceIsCalledAndItsAnswerShown) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/World/Step");
  EXPECT_EQ(topics.watched, "") << "services have no messages";
  topics.answer(true, "n: 3");
  rig.pictures(2);
  rig.click("topics/call");
  EXPECT_EQ(topics.requests.back(), "call /ambf/env/World/Step ambf_msgs/Step n: 3");
  topics.answer(true, "", {{0, false, "success", "true"}, {0, false, "sim_step", "12"}});
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("answer/success"));
  EXPECT_TRUE(rig.shown("answer/sim_step"));
  rig.click("topics/call");
  topics.answer(false, "it failed");
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("answer/success")) << "the answer before is not this one's";
}

TEST_F(PanelTopics, TheKeyboardReachesThem) {
  rig.tab("Topics");
  rig.pictures(2);
  rig.click("topics/search");
  rig.key("Esc");
  for (int i = 0; i < 3; ++i) rig.key("Down");
  rig.key("Enter");
  rig.pictures(2);
  EXPECT_NE(desk.chosen(), "");
  EXPECT_NE(desk.info(), nullptr);
}

TEST_F(PanelTopics, WhatIsWrongIsShownAndCanBeTriedAgain) {
  topics.now.stage = TopicView::Stage::failed;
  topics.now.problem = "there is no ambf-cli";
  rig.tab("Topics");
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("topics/problem"));
  rig.click("topics/retry");
  EXPECT_EQ(topics.retried, 1);
  topics.now.stage = TopicView::Stage::running;
  topics.now.problem = "no ROS master answers";
  rig.pictures(2);
  EXPECT_TRUE(rig.shown("topics/problem"));
  EXPECT_FALSE(rig.shown("topics/retry"));
  EXPECT_TRUE(rig.shown("topics//other/get")) << "what was there stays to be seen";
  topics.now.problem = "";
  topics.now.list = std::make_shared<const std::vector<TopicInfo>>();
  topics.now.stage = TopicView::Stage::starting;
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("topics/problem"));
  EXPECT_TRUE(rig.shown("topics/starting"));
}

TEST_F(PanelTopics, WithoutRosThereIsOnlyTheReason) {
  topics.missing = "no ROS here";
  rig.tab("Topics");
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("topics/search"));
  EXPECT_EQ(desk.unavailable(), "no ROS here");
  EXPECT_FALSE(topics.looked);
}

TEST_F(PanelTopics, WhatIsGoneIsNoLongerActedUpon) {
  rig.tab("Topics");
  rig.pictures(2);
  choose("/ambf/env/box/Command");
  const std::size_t before = topics.requests.size();
  topics.now.list = std::make_shared<const std::vector<TopicInfo>>();
  rig.pictures(2);
  desk.publish_once();
  desk.call();
  desk.fill_in();
  EXPECT_EQ(topics.requests.size(), before);
  EXPECT_EQ(topics.watched, "");
}

TEST(PanelTopicsLayout, TheChosenTopicIsRemembered) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("ambf_panel_topics" + std::to_string(getpid()));
  const std::string settings = (folder / "panel.conf").string();
  FakeTopics topics;
  {
    PanelRig rig(settings, 1600, 2600, 2.0, nullptr, "/arm.yaml", &topics);
    rig.tab("Topics");
    rig.pictures(2);
    rig.click("topics//other/State");
  }
  PanelRig rig(settings, 1600, 2600, 2.0, nullptr, "/arm.yaml", &topics);
  rig.pictures(3);
  EXPECT_EQ(rig.model.topics.chosen(), "/other/State");
  EXPECT_EQ(topics.watched, "/other/State") << "its tab is the one that was open";
  std::filesystem::remove_all(folder);
}

TEST(PanelWithoutTopics, SaysSo) {
  PanelRig rig;
  rig.tab("Topics");
  rig.pictures(2);
  EXPECT_FALSE(rig.shown("topics/search"));
  EXPECT_NE(rig.model.topics.unavailable(), "");
}

TEST(TopicWords, SayHowOftenHowManyAndHowLarge) {
  WatchedMessage message;
  message.count = 1;
  message.bytes = 1;
  EXPECT_EQ(in_words(message, 0.1), "1 so far; the newest: 1 byte");
  message.count = 75;
  message.bytes = 391;
  message.rate_hz = 49.9;
  EXPECT_EQ(in_words(message, 0.1), "50 a second, 75 so far; the newest: 391 bytes");
  message.rate_hz = 2.54;
  message.bytes = 691'252;
  EXPECT_EQ(in_words(message, 0.1), "2.5 a second, 75 so far; the newest: 691 kB");
  message.bytes = 2'764'852;
  EXPECT_EQ(in_words(message, 12.3), "75 so far; the newest: 12 s ago, 2.8 MB");
}

}  // namespace
}  // namespace ambf::render
