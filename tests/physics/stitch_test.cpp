// Thread through punctures: it slides, closes a wound, holds when it is tied, tears out, repeats and is saved. One bite
// is sewn once, and restored for each test.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/suture_rig.h"

namespace ambf::physics {
namespace {

using namespace testing;
using math::Vec3;

constexpr double kYoung = 3e4, kClosed = 0.0005, kPull = 0.5;  // Pa, m, N

const SutureRig::Saved& sewn() {
  static const SutureRig::Saved saved = [] {
    SutureRig rig(0.012, 5.0, kYoung);
    rig.bite();
    return rig.saved();
  }();
  return saved;
}

struct Sewn : SutureRig {
  explicit Sewn(double strength = 5.0) : SutureRig(0.012, strength, kYoung) { restore(sewn()); }
};

TEST(Stitch, TheThreadStaysWhereTheNeedleWent) {
  Sewn rig;
  EXPECT_EQ(rig.needle.punctures(), 0U);
  EXPECT_GE(rig.needle.stitches(), 6U) << "those within the tissue, too";
  const auto found = rig.needle.on_surfaces();
  ASSERT_EQ(found.size(), 4U) << "in and out of both lips";
  EXPECT_GT(found[0].needle.x, 0.018) << "the oldest";
  EXPECT_LT(found[3].needle.x, 0.010);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found[i].body, rig.tissue.get());
    EXPECT_GT(found[i].thread, i == 3 ? 0.05 : found[i + 1].thread) << "drawn through";
    // The thread itself is there.
    EXPECT_LT(math::norm(rig.thread->position_at(found[i].thread) - found[i].needle), 0.001) << i;
  }
}

// Bar 8 of the issue.
TEST(Stitch, ThePullClosesTheGapWhichOpensAgain) {
  Sewn rig;
  rig.pull_end(kPull);
  rig.wait(200);
  EXPECT_LT(std::abs(rig.gap()), kClosed);
  EXPECT_NEAR(rig.thread->length() / rig.thread->rest_length(), 1.0, 0.005);
  // Through the tissue, but for friction, to the needle.
  EXPECT_NEAR(math::norm(rig.end.held()[0].force_world), kPull, 0.04);
  EXPECT_LT(math::norm(rig.needle.force_world()), kPull);
  EXPECT_GT(math::norm(rig.needle.force_world()), 0.8 * kPull);
  EXPECT_NEAR(math::norm(rig.tissue->force_on(rig.hand)), math::norm(rig.needle.force_world()), 1e-9);
  rig.end.release();
  rig.wait(200);
  EXPECT_GT(rig.gap(), 0.0025);
  EXPECT_LT(rig.gap(), 0.0032);
}

// The same as in one tissue, though each of the two is stepped by itself.
TEST(Stitch, ClosesAWoundBetweenTwoTissues) {
  SutureRig one(0.012, 5.0, kYoung), two(0.012, 5.0, kYoung, 0.14, true);
  one.bite(), two.bite();
  ASSERT_EQ(two.needle.on_surfaces().size(), 4U);
  double gaps = 0.0, forces = 0.0;
  for (const double pull : {kPull, 0.0, 2.0 * kPull}) {
    for (SutureRig* rig : {&one, &two}) pull > 0.0 ? rig->pull_end(pull) : rig->end.release();
    for (int i = 0; i < 200; ++i) {
      for (SutureRig* rig : {&one, &two}) rig->wait(1);
      gaps = std::max(gaps, std::abs(one.gap() - two.gap()));
      forces = std::max(forces, math::norm(one.needle.force_world() - two.needle.force_world()));
    }
    if (pull == kPull) {
      EXPECT_LT(std::abs(two.gap()), kClosed);
    }
    if (pull == 0.0) {
      EXPECT_GT(two.gap(), 0.0025);
    }
  }
  EXPECT_LT(gaps, 0.0004) << "at any time, also while it opens";
  EXPECT_LT(forces, 0.08);
}

// Forceps at the end of the thread go away from the wound, then stand still.
TEST(Stitch, ATautThreadDoesNotTremble) {
  SutureRig rig(0.018, 5.0, 2e4);
  rig.bite();
  SoftGrip grip({300.0, 0.5});
  Body forceps(mass_only(0.0, {}, {rig.thread->position(rig.thread->node_count() - 1), {}}));
  rig.world.add(forceps);
  for (const std::size_t back : {1, 2}) grip.hold(forceps, *rig.thread, rig.thread->node_count() - back);
  rig.wait(50);  // it lies on itself after the bite, and settles
  const Vec3 from = forceps.pose().position;
  double worst = 0.0, gap = rig.gap(), before = 0.0;
  for (int far = 0; far < 60; ++far) {
    forceps.move_to({from + Vec3{-0.001 * far, 0, -0.0003 * far}, {}});
    rig.wait(20);
    for (int i = 0; i < 10; ++i) {
      before = rig.gap();
      rig.wait(1);
      worst = std::max(worst, std::abs(rig.gap() - before));
    }
    gap = std::min(gap, rig.gap());
  }
  EXPECT_LT(gap, 0.0015);
  EXPECT_LT(worst, 3e-5) << "m, in a step";
  grip.release();
  rig.world.remove(forceps);
}

TEST(Stitch, AKnotHoldsUntilItIsUntied) {
  Sewn rig;
  rig.pull_end(kPull);
  rig.wait(200);
  EXPECT_EQ(rig.needle.tied(), 0U);
  EXPECT_TRUE(rig.needle.tie());
  EXPECT_EQ(rig.needle.tied(), rig.needle.stitches());
  EXPECT_FALSE(rig.needle.tie()) << "nothing is left to tie";
  const auto thread = [&] {
    std::vector<double> s;
    for (const SurfacePuncture& each : rig.needle.on_surfaces()) s.push_back(each.thread);
    return s;
  };
  const std::vector<double> tied = thread();
  rig.end.release();
  rig.wait(200);
  EXPECT_LT(std::abs(rig.gap()), kClosed);
  rig.pull_end(kPull);
  rig.wait(200);
  EXPECT_LT(std::abs(rig.gap()), kClosed);
  EXPECT_EQ(thread(), tied);
  rig.needle.untie();
  rig.end.release();
  rig.wait(200);
  EXPECT_GT(rig.gap(), 0.0025);
}

// What a saved state says of the needle: stitches from the thread's first node on, then knots.
using State = std::vector<double>;

State state_of(const Needle& needle) {
  State state;
  needle.get_state(state);
  return state;
}

// Where the records begin whose last number is from..below: 10 to 13 are stitches, 20 to 21 knots.
std::vector<std::size_t> records(const State& state, double from, double below) {
  std::vector<std::size_t> found;
  for (std::size_t at = 6; at < state.size(); at += 8)
    if (state[at + 7] >= from && state[at + 7] < below) found.push_back(at);
  return found;
}

TEST(Stitch, AKnotThatLosesAnEndIsAsLongAsItIsNow) {
  Sewn rig;
  ASSERT_TRUE(rig.needle.tie());
  State state = state_of(rig.needle);
  const std::size_t last = records(state, 10, 13).back();
  const double before = state[records(state, 20, 21).at(0) + 5];
  state[last + 5] = rig.thread->rest_length();  // the thread's end is at it, and comes through
  const std::size_t all = rig.needle.tied();
  rig.needle.set_state(rig.world, state);
  rig.wait(1);
  EXPECT_EQ(rig.needle.tied(), all - 1);
  state = state_of(rig.needle);
  const auto place = [&](std::size_t at) { return Vec3{state[at + 2], state[at + 3], state[at + 4]}; };
  const std::vector<std::size_t> left = records(state, 10, 13);
  const double now = state[records(state, 20, 21).at(0) + 5];
  EXPECT_LT(now, before - 0.0005);
  const double as_loaded = math::norm(place(left.back()) - place(left.front()));  // the lips are nearer by up to 3 mm
  EXPECT_GT(now, as_loaded - 0.003);
  EXPECT_LT(now, as_loaded);
}

TEST(Stitch, IsInNoKnotThatASavedStateLacks) {
  Sewn rig;
  ASSERT_TRUE(rig.needle.tie());
  State state = state_of(rig.needle);
  const auto knot = state.begin() + static_cast<std::ptrdiff_t>(records(state, 20, 21).at(0));
  state.erase(knot, knot + 8);
  const std::size_t all = rig.needle.stitches();
  rig.needle.set_state(rig.world, state);
  EXPECT_EQ(rig.needle.stitches(), all);
  EXPECT_EQ(rig.needle.tied(), 0U);
  EXPECT_TRUE(rig.needle.tie());
}

TEST(Stitch, TearsOutAboveItsStrength) {
  for (const double strength : {0.3, 5.0}) {
    Sewn rig(strength);
    rig.pull_end(2.0);
    rig.wait(200);
    EXPECT_EQ(rig.needle.stitches() < 4, strength < 1.0) << rig.needle.stitches();
    EXPECT_FALSE(rig.tissue->divergence());
  }
}

TEST(Stitch, RepeatsAndIsSaved) {
  Sewn first, again;
  SutureRig other(0.012, 5.0, kYoung);
  for (SutureRig* each : {static_cast<SutureRig*>(&first), static_cast<SutureRig*>(&again)}) {
    each->wait(50);
    each->needle.tie();
    each->restore(each->saved());
  }
  other.restore(first.saved());
  EXPECT_EQ(other.needle.tied(), first.needle.tied());
  for (SutureRig* each : {static_cast<SutureRig*>(&first), static_cast<SutureRig*>(&again), &other}) {
    each->go({0.01, 0.002, 0.01}, 100);
    each->needle.untie();
    each->pull_end(0.5);
    each->wait(100);
  }
  const auto all = [](const SutureRig& rig) {
    const SutureRig::Saved saved = rig.saved();
    std::vector<double> sum = saved.tissue;
    sum.insert(sum.end(), saved.thread.begin(), saved.thread.end());
    sum.insert(sum.end(), saved.needle.begin(), saved.needle.end());
    return sum;
  };
  EXPECT_EQ(all(first), all(again));
  EXPECT_EQ(all(first), all(other));
  // What cannot be is left out.
  const std::vector<double> good = first.saved().needle;
  ASSERT_GE(good.size(), 14U);
  for (const auto& [number, value] : {std::pair{6, -3.0}, {7, 1e9}, {8, NAN}, {11, 99.0}, {11, NAN}, {12, 1e9}}) {
    std::vector<double> forged = good, now;
    forged[static_cast<std::size_t>(number)] = value;
    first.needle.set_state(first.world, forged);
    first.needle.get_state(now);
    EXPECT_LT(now.size(), good.size()) << number;
  }
}

TEST(Stitch, WhatTakesPartMayGo) {
  for (const int gone : {0, 1, 2, 3}) {
    SCOPED_TRACE(gone);
    Sewn rig;
    rig.pull_end(kPull);
    rig.wait(20);
    rig.needle.tie();
    if (gone == 0) {
      remove(rig.world, *rig.thread);
      rig.thread = nullptr;
    } else if (gone == 1) {
      remove(rig.world, *rig.tissue);
      rig.tissue = nullptr;
    } else if (gone == 2) {
      rig.world.remove(rig.hand);
    } else {
      remove(rig.world, rig.needle);
    }
    EXPECT_EQ(rig.needle.stitches(), 0U);
    EXPECT_EQ(rig.needle.tied(), 0U);
    rig.wait(20);
    if (rig.thread != nullptr) {
      EXPECT_FALSE(rig.thread->divergence());
    }
    if (gone == 2) rig.world.add(rig.hand);
    if (gone == 3) add(rig.world, rig.needle);
  }
}

// The first needle's hand is at the wound; the second one's, away from all.
TEST(Stitch, OfTwoNeedlesOfOneThreadTheLastHasItUntilItGoes) {
  for (const int gone : {0, 1, 2, 3}) {
    SCOPED_TRACE(gone);
    SutureRig rig;
    Body other(mass_only(0.0, {}, {{0.0, 0.05, 0.05}, {}}));
    rig.world.add(other);
    Needle second(SutureRig::options(5.0));
    add(rig.world, second);
    second.use(&other);
    second.draw(rig.thread.get());
    const auto off = [&](const Body& hand) {
      return math::norm(rig.thread->position(0) - hand.pose() * Vec3{-SutureRig::kRadius, 0, 0});
    };
    rig.wait(200);
    EXPECT_LT(off(other), 0.001);
    // The one without the thread goes.
    if (gone == 0) remove(rig.world, rig.needle);
    if (gone == 1) rig.needle.draw(nullptr);
    // The one that has it goes.
    if (gone == 2) remove(rig.world, second);
    if (gone == 3) rig.world.remove(other);
    rig.wait(200);
    EXPECT_LT(off(gone < 2 ? other : rig.hand), 0.001);
    if (gone == 0) add(rig.world, rig.needle);
    if (gone != 3) rig.world.remove(other);
    if (gone != 2) remove(rig.world, second);
  }
}

TEST(Stitch, WhatPassesANeedleWithoutItsThreadIsLeft) {
  SutureRig rig;
  Body other(mass_only(0.0, {}, {{0.0, 0.05, 0.05}, {}}));
  rig.world.add(other);
  Needle second(SutureRig::options(5.0));
  add(rig.world, second);
  second.use(&other);
  second.draw(rig.thread.get());
  rig.bite();
  EXPECT_EQ(rig.needle.punctures(), 0U);
  EXPECT_EQ(rig.needle.stitches(), 0U);
  remove(rig.world, second);
  rig.world.remove(other);
}

}  // namespace
}  // namespace ambf::physics
