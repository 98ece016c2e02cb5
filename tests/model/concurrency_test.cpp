// Commands in flight while objects come and go: run under ThreadSanitizer too.
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "rig.h"

namespace ambf::model::test {
namespace {

// Hands a value from one thread to another.
template <class T>
class HandOver {
 public:
  void put(T value) {
    const std::lock_guard lock(mutex_);
    values_.push_back(std::move(value));
  }
  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    if (values_.empty()) return std::nullopt;
    std::optional<T> value(std::move(values_.front()));
    values_.erase(values_.begin());
    return value;
  }

 private:
  std::mutex mutex_;
  std::vector<T> values_;
};

// Every command pushes equally along x, y and z. A torn or misdirected one would show as unequal velocities.
TEST(CommandsInFlight, AreNeverTornNorReachAnotherObjectWhileModelsComeAndGo) {
  Rig rig;
  scene::Body lasting = box("lasting", 1.0, {0, 0, 0});
  scene::Body untouched = box("untouched", 1.0, {90, -90, 0});
  rig.load(model("lasting.yaml", {lasting, untouched}));
  const state::ObjectId lasting_id = rig.id("lasting");

  std::atomic<bool> done{false};
  std::atomic<std::uint32_t> newest_index{lasting_id.index}, newest_generation{lasting_id.generation};
  HandOver<Prepared> prepared;
  HandOver<Garbage> garbage;

  std::thread loader([&] {
    for (int i = 0; i < 60; ++i) {
      Prepared load = rig.catalogue.prepare_load(model("guest.yaml", {box("guest", 1.0, {300, 0, 0})}));
      const state::ObjectId guest = load.structure->objects.back().id;
      prepared.put(std::move(load));
      newest_index = guest.index;
      newest_generation = guest.generation;
      std::this_thread::yield();
      prepared.put(rig.catalogue.prepare_unload("guest.yaml"));
      while (garbage.take()) {
      }
    }
    done = true;
  });
  std::vector<std::thread> writers;
  for (int w = 0; w < 3; ++w) {
    writers.emplace_back([&, w] {
      std::mt19937 random(static_cast<unsigned>(w));
      const auto source = static_cast<state::Source>(w);
      const auto lasting_port = rig.commands.bind(lasting_id, source);
      while (!done) {
        const double push = std::uniform_real_distribution<double>(-5, 5)(random);
        lasting_port->post(force({push, push, push}));
        if (const auto guest = rig.commands.bind({newest_index, newest_generation}, source)) {
          guest->post(force({push, push, push}));
          if (push > 4) guest->release();
          if (push < -4) guest->keep_alive();
        }
        std::this_thread::yield();
      }
      lasting_port->release();
    });
  }

  int unequal = 0;
  bool moved = false;
  while (!done) {
    while (auto change = prepared.take()) {
      rig.frame = std::move(change->frames.front());
      garbage.put(rig.live->apply(std::move(*change)));
    }
    rig.step(3);
    for (std::size_t slot = 0; slot < rig.frame->bodies.size(); ++slot) {
      const math::Vec3& v = rig.frame->bodies[slot].twist_world.linear;
      if (v.x != v.y || v.y != v.z) ++unequal;
      moved = moved || v.x != 0.0;
    }
    EXPECT_EQ(rig.body("untouched").twist_world.linear, (math::Vec3{0, 0, 0}));
  }
  loader.join();
  for (std::thread& writer : writers) writer.join();
  while (auto change = prepared.take()) {
    rig.frame = std::move(change->frames.front());
    garbage.put(rig.live->apply(std::move(*change)));
  }
  rig.step();
  EXPECT_EQ(unequal, 0);
  EXPECT_TRUE(moved);
  EXPECT_EQ(rig.frame->bodies.size(), 2u);
  EXPECT_FALSE(rig.body("lasting").active);  // every writer let go
}

}  // namespace
}  // namespace ambf::model::test
