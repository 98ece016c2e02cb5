// Two lips of tissue, 3 mm apart, a half circle needle of 26 mm on a hand, and a thread at its rear.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "physics/needle.h"
#include "physics/soft_grip.h"
#include "physics/thread.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/tissue_block.h"

namespace ambf::physics::testing {

struct SutureRig {
  static constexpr double kRadius = 0.026 / M_PI, kTop = 0.009, kMiddle = 0.0135, kBite = 0.0051;
  static constexpr double kOut = 2.0 * M_PI - 0.1;  // the needle has gone all the way through

  // The outer sides of both lips, 12 mm each, are fixed. `two`: each lip is a tissue.
  explicit SutureRig(double width = 0.012, double strength = 5.0, double young = 2e4, double thread_m = 0.14,
                     bool two = false)
      : SutureRig(held_outside(two ? lip(width) : blocks(width), young), width, options(strength), thread_m,
                  two ? std::optional(held_outside(lip(width, 0.015), young)) : std::nullopt) {}
  // Of any lips, whose inner sides are at x = 12 and 15 mm, and their top at kTop; `second`: a tissue of its own.
  SutureRig(const TissueDefinition& lips, double width, const NeedleOptions& given, double thread_m = 0.14,
            const std::optional<TissueDefinition>& second = std::nullopt)
      : world(without_gravity()), hand(mass_only(0.0, {}, pose(-0.1, 0.5 * width))), needle(given) {
    if (second) other = std::make_unique<Tissue>(*second);
    tissue = std::make_unique<Tissue>(lips);
    for (std::size_t i = 0; i < node_count(); ++i) loaded.push_back(node(i));
    const math::Vec3 rear = hand.pose() * math::Vec3{-kRadius, 0, 0};
    ThreadDefinition suture;
    const int segments = static_cast<int>(std::lround(thread_m / 0.002));
    for (int i = 0; i <= segments; ++i) suture.nodes.push_back(rear + math::Vec3{0, 0, 0.002 * i});
    thread = std::make_unique<Thread>(suture);
    add(world, *tissue);
    if (other != nullptr) add(world, *other);
    add(world, *thread);
    world.add(hand);
    add(world, needle);
    needle.use(&hand);
    needle.draw(thread.get());
  }
  ~SutureRig() {
    remove(world, needle);
    world.remove(hand);
    if (thread != nullptr) remove(world, *thread);
    if (tissue != nullptr) remove(world, *tissue);
    if (other != nullptr) remove(world, *other);
  }

  static TissueSurface lip(double width, double x = 0.0) { return block({0.012, width, kTop}, {x, 0, 0}); }
  static TissueSurface blocks(double width) { return both(lip(width), lip(width, 0.015)); }
  static TissueSurface both(TissueSurface one, const TissueSurface& more) {
    const auto first = static_cast<std::uint32_t>(one.vertices.size());
    one.vertices.insert(one.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& t : more.triangles) one.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return one;
  }
  static TissueDefinition held_outside(const TissueSurface& surface, double young, double element = 0.003001) {
    return held_outside(tissue_of(surface, element, young));
  }
  static TissueDefinition held_outside(TissueDefinition made) {
    for (std::uint32_t i = 0; i < made.grid.corners.size(); ++i)
      if (made.grid.corners[i].x < 1e-6 || made.grid.corners[i].x > 0.027 - 1e-6) made.fixed.push_back(i);
    return made;
  }
  // Of two halves of a body whose top is at their origin: fixed below and at both ends.
  static TissueDefinition wounded(const std::array<TissueSurface, 2>& halves, double young) {
    const math::Vec3 top{kMiddle, kBite, kTop};
    TissueSurface wound = both(halves[0], halves[1]);
    for (math::Vec3& vertex : wound.vertices) vertex += top;
    TissueDefinition made = tissue_of(wound, 0.006, young);
    for (std::uint32_t i = 0; i < made.grid.corners.size(); ++i)
      if (const math::Vec3 off = made.grid.corners[i] - top; std::abs(off.x) > 0.0135 || off.z < -0.012)
        made.fixed.push_back(i);
    return made;
  }
  // Of both lips.
  std::size_t node_count() const { return tissue->node_count() + (other == nullptr ? 0 : other->node_count()); }
  math::Vec3 node(std::size_t i) const {
    return i < tissue->node_count() ? tissue->position(i) : other->position(i - tissue->node_count());
  }

  static WorldOptions without_gravity() {
    WorldOptions made;
    made.gravity = {};
    return made;
  }
  static NeedleOptions options(double strength, double puncture = 0.05) {
    return {{{kRadius, 0, 0}, {0, 0, kRadius}, {-kRadius, 0, 0}}, puncture, 2.0, strength};
  }
  // About the middle of its circle, above the wound; from 0 to 2 pi it goes through once, from right to left.
  static math::Pose pose(double angle, double y) {
    return {{kMiddle, y, kTop + 0.0025}, {0, std::sin(0.5 * angle), 0, std::cos(0.5 * angle)}};
  }
  void turn(double from, double to, double y, int steps) {
    for (int i = 1; i <= steps; ++i) {
      hand.move_to(pose(from + (to - from) * i / steps, y));
      world.step();
    }
  }
  void go(const math::Vec3& way, int steps) {
    const math::Pose from = hand.pose();
    for (int i = 1; i <= steps; ++i) {
      hand.move_to({from.position + way * (static_cast<double>(i) / steps), from.orientation});
      world.step();
    }
  }
  void wait(int steps) {
    for (int i = 0; i < steps; ++i) world.step();
  }
  // One bite; then the needle draws thread through, and crosses to the other side.
  void bite() {
    turn(-0.1, kOut, kBite, 500);
    go({-0.02, 0, 0.03}, 150);
    go({0.07, 0, 0}, 150);
  }
  struct Saved {
    std::vector<double> tissue, thread, needle;
    math::Pose hand;
  };
  Saved saved() const {
    Saved all;
    tissue->get_state(all.tissue);
    thread->get_state(all.thread);
    needle.get_state(all.needle);
    all.hand = hand.pose();
    return all;
  }
  void restore(const Saved& from) {
    tissue->set_state(from.tissue);
    thread->set_state(from.thread);
    hand.set_pose(from.hand);
    needle.set_state(world, from.needle);
  }
  // A row of bites along the wound, each drawn tight by hand, so that some 6 cm of thread are left before the first.
  void sew(int bites, double first_y, double apart) {
    double slack = 0.0;  // m, between the last bite and the needle
    for (int i = 0; i < bites; ++i) {
      const double y = first_y + apart * i;
      const math::Vec3 above = pose(-0.1, y).position + math::Vec3{0, 0, 0.02};
      go(above - hand.pose().position, 100);
      hand.move_to({above, pose(-0.1, y).orientation});
      world.step();
      go({0, 0, -0.02}, 50);
      turn(-0.1, kOut, y, 800);
      const double all = thread->rest_length() - 0.06;
      slack = (i == 0 ? all : slack) - 0.022;
      go({-0.01, 0, 0.02}, 60);
      go({0, 0, slack - 0.02}, 400);
      if (i + 1 < bites) go({0, 0, 0.03 - slack}, 300);
    }
  }
  // A hand takes the thread's end and pulls it to the left with this force (N).
  void pull_end(double force) {
    end.release();
    end.set_max_force(force);
    end.hold_in_world(world, *thread, thread->node_count() - 1);
    end.shift({-0.3, 0, -0.05});
  }
  // m, how far a place is from the way of the needle's tip in a bite there.
  static double off_path(const math::Vec3& at, double y = kBite) {
    return std::hypot(std::hypot(at.x - kMiddle, at.z - kTop - 0.0025) - kRadius, at.y - y);
  }
  // m, between the inner sides of the lips, within 2.5 mm of y and as deep as that.
  double gap(double y = kBite, double depth = 1.0) const {
    double sum[2] = {};
    int count[2] = {};
    for (std::size_t i = 0; i < loaded.size(); ++i) {
      const math::Vec3& at = loaded[i];
      if (std::abs(at.y - y) > 0.0025 || at.z < kTop - depth) continue;
      const int side = std::abs(at.x - 0.012) < 1e-6 ? 0 : std::abs(at.x - 0.015) < 1e-6 ? 1 : -1;
      if (side < 0) continue;
      sum[side] += node(i).x;
      ++count[side];
    }
    return sum[1] / count[1] - sum[0] / count[0];
  }

  World world;
  Body hand;
  Needle needle;
  SoftGrip end;
  std::unique_ptr<Tissue> tissue, other;
  std::unique_ptr<Thread> thread;
  std::vector<math::Vec3> loaded;  // nodes of the tissue
};

}  // namespace ambf::physics::testing
