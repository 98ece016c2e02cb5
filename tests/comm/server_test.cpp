#include "comm/server.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fakes.h"

namespace ambf::comm {
namespace {

using testing::eventually;
using testing::FakeMiddleware;
using testing::FakeSimulation;
using testing::Scene;
using Names = std::multiset<std::string>;

class CommServer : public ::testing::Test {
 protected:
  void start(ServerOptions options = {}) {
    show();
    server = std::make_unique<Server>(simulation, middleware, std::move(options));
  }
  void show() { simulation.show(scene.next()); }
  // Frames every millisecond, as a running simulation shows them.
  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      show();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  bool opened(const Names& names) {
    return eventually([&] { return middleware.open_addresses() == names; });
  }

  FakeSimulation simulation;
  FakeMiddleware middleware;
  Scene scene;
  std::unique_ptr<Server> server;
};

TEST_F(CommServer, OpensTheWorldFirstAndEveryObjectThatIsServedAndNotPassive) {
  middleware.opening_us = 500;
  scene.set_bodies({"a", "passive b", "unserved d", "c"});
  start();  // the middleware itself expects the world to be first
  EXPECT_TRUE(opened({"/env/World", "a", "c"}));
  EXPECT_TRUE(eventually([&] { return server->open_endpoints() == 3; }));
}

TEST_F(CommServer, FollowsObjectsThatComeAndGo) {
  scene.set_bodies({"a", "b"});
  start();
  ASSERT_TRUE(opened({"/env/World", "a", "b"}));
  scene.set_bodies({"b", "c"});
  show();
  EXPECT_TRUE(opened({"/env/World", "b", "c"}));
  run(100);
  // b has moved to the first place of the arrays.
  ASSERT_FALSE(middleware.record("b").slots.empty());
  EXPECT_EQ(middleware.record("b").slots.back(), 0u);
  EXPECT_EQ(middleware.reserved(), 3u);
}

TEST_F(CommServer, ANameThatIsFreedIsGivenAgainWithoutANumber) {
  scene.set_bodies({"a"});
  start();
  ASSERT_TRUE(opened({"/env/World", "a"}));
  for (int i = 0; i < 50; ++i) {
    scene.replace_bodies({"a"});
    show();
    std::this_thread::sleep_for(std::chrono::microseconds(700));
  }
  EXPECT_TRUE(opened({"/env/World", "a"}));
  EXPECT_EQ(middleware.reserved(), 2u);
}

TEST_F(CommServer, KeepsTryingWhatCannotBeOpened) {
  middleware.is_available = false;
  scene.set_bodies({"a", "b", "c"});
  start();
  run(250);
  EXPECT_TRUE(middleware.open_addresses().empty());
  middleware.failures = 3;
  middleware.is_available = true;
  EXPECT_TRUE(opened({"/env/World", "a", "b", "c"}));
}

TEST_F(CommServer, OffersNothingWhileTheWorldIsTaken) {
  middleware.world_taken = true;
  scene.set_bodies({"a", "b"});
  start();
  run(300);
  EXPECT_TRUE(middleware.open_addresses().empty());
  middleware.world_taken = false;
  EXPECT_TRUE(opened({"/env/World", "a", "b"}));
}

TEST_F(CommServer, PublishesIdleObjectsSlowlyAndCommandedOnesWithEveryFrame) {
  scene.set_bodies({"a"});
  start();
  ASSERT_TRUE(opened({"/env/World", "a"}));
  run(1000);
  const std::size_t idle = middleware.record("a").steps.size();
  scene.active = true;
  run(1000);
  std::vector<std::uint32_t> steps = middleware.record("a").steps;
  steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(idle));
  EXPECT_GT(steps.size(), 5 * idle);
  // Nothing is said twice.
  EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
  const std::size_t count = steps.size();
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  EXPECT_GE(static_cast<double>(steps.size()), 0.95 * static_cast<double>(count));
}

TEST_F(CommServer, PublishesNothingThatNobodyListensTo) {
  middleware.subscribed = false;
  scene.set_bodies({"a"});
  start();
  ASSERT_TRUE(opened({"/env/World", "a"}));
  run(200);
  EXPECT_TRUE(middleware.record("a").steps.empty());
  EXPECT_GT(middleware.record("a").watched, 0u) << "watchdogs look on all the same";
  middleware.subscribed = true;
  run(100);
  EXPECT_FALSE(middleware.record("a").steps.empty());
}

TEST_F(CommServer, SaysWhetherCommandsAreInForce) {
  scene.set_bodies({"a"});
  start();
  ASSERT_TRUE(opened({"/env/World", "a"}));
  scene.active = true;
  show();
  EXPECT_TRUE(eventually([&] { return middleware.record("a").last_active; }));
  scene.active = false;
  show();
  EXPECT_TRUE(eventually([&] { return !middleware.record("a").last_active; }));
}

TEST_F(CommServer, AFinishedToggleIsShownOnceOnEveryObject) {
  scene.set_bodies({"a", "b"});
  start({{1.0, 1.0}, 2, {}});  // far too slow to show it by themselves
  ASSERT_TRUE(opened({"/env/World", "a", "b"}));
  scene.throttled = true;
  run(50);
  for (int i = 0; i < 20; ++i) {
    const std::size_t before = middleware.record("b").steps.size();
    ++scene.toggles;
    const auto frame = scene.next();
    simulation.show(frame);
    for (const char* name : {"/env/World", "a", "b"}) {
      EXPECT_TRUE(eventually([&] {
        const auto steps = middleware.record(name).steps;
        return !steps.empty() && steps.back() == frame->sim_step;
      })) << name;
    }
    EXPECT_LE(middleware.record("b").steps.size(), before + 2);  // itself, and the slow rate's own
  }
}

TEST_F(CommServer, TellsWhatItsThreadCostsAFrame) {
  scene.set_bodies({"a", "b"});
  middleware.publishing_us = 500;
  scene.active = true;
  start({{1000.0, 1000.0}, 2, {}});
  ASSERT_TRUE(opened({"/env/World", "a", "b"}));
  // Three publications of 0.5 ms a frame; slower frames than publications, so that none is left out.
  const auto told = [&] {
    show();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return simulation.reported_s > 1.4e-3;
  };
  EXPECT_TRUE(eventually(told)) << simulation.reported_s.load();
  middleware.subscribed = false;  // then there is nothing to hand over
  EXPECT_TRUE(eventually([&] {
    told();
    return simulation.reported_s < 0.7e-3;
  })) << simulation.reported_s.load();
}

TEST_F(CommServer, EndsInEveryStateWithEverythingClosed) {
  for (int delay_us : {0, 100, 1000, 5000, 20000}) {
    for (const bool available : {true, false}) {
      middleware.is_available = available;
      middleware.opening_us = 300;
      std::vector<std::string> names;
      for (int i = 0; i < 40; ++i) names.push_back("body" + std::to_string(i));
      scene.set_bodies(names);
      start();
      std::this_thread::sleep_for(std::chrono::microseconds(delay_us));
      scene.set_bodies({"body7", "other"});
      show();
      server.reset();
      EXPECT_TRUE(middleware.open_addresses().empty());
      EXPECT_EQ(middleware.reserved(), 0u);
    }
  }
}

TEST_F(CommServer, EndsWithoutHavingSeenAFrame) {
  server = std::make_unique<Server>(simulation, middleware, ServerOptions{});
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  server.reset();
  EXPECT_TRUE(middleware.open_addresses().empty());
}

TEST_F(CommServer, PublishesEveryStepThatARecorderWants) {
  scene.set_bodies({"a", "b"});
  middleware.step_interval = 2;
  start();
  ASSERT_TRUE(opened({"/env/World", "a", "b"}));
  // Who subscribes while the world waits sees its state, once.
  for (const char* body : {"a", "b"}) {
    ASSERT_TRUE(eventually([&] { return middleware.record(body).steps.size() == 1; }));
  }
  std::vector<std::uint32_t> wanted = middleware.record("a").steps;
  for (int i = 0; i < 500; ++i) {
    const auto step = scene.next();
    if (step->sim_step % 2 == 0) wanted.push_back(step->sim_step);
    simulation.run_step(step);
    if (i % 50 == 0) simulation.show(step);
  }
  EXPECT_TRUE(eventually([&] { return middleware.record("b").steps.size() >= wanted.size(); }));
  EXPECT_EQ(middleware.record("a").steps, wanted);
  EXPECT_EQ(middleware.record("b").steps, wanted);

  middleware.step_interval = 0;
  const std::size_t before = middleware.record("a").steps.size();
  run(100);
  EXPECT_GT(middleware.record("a").steps.size(), before) << "at its rates again";
}

TEST_F(CommServer, StepsOfANewStructureArePublishedInItsOrder) {
  scene.set_bodies({"a", "b"});
  middleware.step_interval = 1;
  start();
  ASSERT_TRUE(opened({"/env/World", "a", "b"}));
  ASSERT_TRUE(eventually([&] { return middleware.record("b").steps.size() == 1; }));
  simulation.run_step(scene.next());
  scene.set_bodies({"b"});
  simulation.run_step(scene.next());
  show();
  EXPECT_TRUE(eventually([&] { return middleware.record("b").slots == std::vector<std::uint32_t>{1, 1, 0}; }));
  EXPECT_EQ(middleware.record("a").slots.size(), 2u);
}

}  // namespace
}  // namespace ambf::comm
