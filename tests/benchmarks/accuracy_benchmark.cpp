// How exactly bodies move: the cases of docs/accuracy.md at steps of 4 to 0.1 ms against closed forms and integration
// to ten digits. Usage: ambf_accuracy_benchmark [part of a case's name]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tests/benchmarks/accuracy_cases.h"
#include "tests/benchmarks/accuracy_reference.h"

namespace ambf::accuracy {

double energy_of(const physics::Body& body, double g) {
  const math::Vec3 omega = math::rotate(math::inverse(body.com_pose().orientation), body.twist().angular);
  const math::Vec3 v = body.twist().linear;
  return 0.5 * body.mass() * math::dot(v, v) + 0.5 * math::dot(omega, math::scaled(omega, body.inertia())) +
         body.mass() * g * body.com_pose().position.z;
}

}  // namespace ambf::accuracy

namespace {

using namespace ambf;
using namespace ambf::physics;
using namespace ambf::physics::testing;
using namespace ambf::accuracy;

constexpr double kSeconds = 10.0;

struct Case {
  std::string name;
  std::function<Figures(double h)> run;
};

math::Vec3 spin_momentum(const Body& body) {
  const math::Quat attitude = body.com_pose().orientation;
  return math::rotate(attitude,
                      math::scaled(math::rotate(math::inverse(attitude), body.twist().angular), body.inertia()));
}

// scpeters' boxes, "complex": thrown and tumbling about its middle axis.
Figures tumbling_box(double h) {
  const double g = 9.8;
  const math::Vec3 inertia{10.0 / 12.0 * (0.16 + 0.81), 10.0 / 12.0 * (0.01 + 0.81), 10.0 / 12.0 * (0.01 + 0.16)};
  const math::Vec3 v{-2.0, 2.0, 8.0}, omega{0.1, 5.0, 0.1};
  World world(options(h, {0.0, 0.0, -g}));
  Body box(mass_only(10.0, inertia));
  world.add(box);
  box.set_twist({v, omega});
  const math::Vec3 momentum = spin_momentum(box);
  const double energy = energy_of(box, g);
  double momentum_error = 0.0, energy_error = 0.0;
  for (int i = steps_in(kSeconds, h); i > 0; --i) {
    world.step();
    momentum_error = std::max(momentum_error, math::norm(spin_momentum(box) - momentum) / math::norm(momentum));
    energy_error = std::max(energy_error, std::abs(energy_of(box, g) - energy) / energy);
  }
  const math::Vec3 fallen = v * kSeconds - math::Vec3{0, 0, 0.5 * g * kSeconds * kSeconds};
  const double attitude = angle_between(tumbled(inertia, omega, kSeconds), box.com_pose().orientation);
  return {{"momentum, share", momentum_error},
          {"energy, share", energy_error},
          {"attitude, rad", attitude},
          {"position, m", math::norm(box.com_pose().position - fallen)}};
}

Figures gyroscope(double h) {
  World world(options(h, {}));
  Body body(mass_only(1.0, {2e-3, 1e-3, 3e-3}));
  world.add(body);
  body.set_twist({{}, {10.0, 5.0, 300.0}});
  const math::Vec3 momentum = spin_momentum(body);
  const double energy = energy_of(body, 0.0);
  run(world, kSeconds);
  return {{"momentum lost, share", math::norm(spin_momentum(body) - momentum) / math::norm(momentum)},
          {"energy lost, share", std::abs(energy_of(body, 0.0) - energy) / energy}};
}

Figures heavy_top(double h) {
  const Top top{1.0, 0.1, 1.6e-3, 3.2e-3, kPi / 6.0, 100.0, 9.8};
  World world(options(h, {0.0, 0.0, -top.g}));
  Body post(mass_only(0.0, {})), body([&] {
    math::Pose at{{}, math::from_axis_angle({1.0, 0.0, 0.0}, top.tilt)};
    at.position = math::rotate(at.orientation, {0.0, 0.0, top.lever});
    return mass_only(top.mass, {top.across, top.across, top.along}, at);
  }());
  Joint tip(joint_of(state::JointType::p2p, {}, {0.0, 0.0, -top.lever}), post, body);
  world.add(post);
  world.add(body);
  world.add(tip);
  const math::Vec3 axis = math::rotate(body.com_pose().orientation, {0.0, 0.0, 1.0});
  body.set_twist({{}, axis * top.spin});
  const double every = 0.02;
  const auto wanted = top_angles(top, every, steps_in(kSeconds, every) + 1);
  double tilt_error = 0.0, gap = 0.0, precession = 0.0, last = std::atan2(axis.y, axis.x);
  for (std::size_t sample = 1; sample < wanted.size(); ++sample) {
    for (int i = steps_in(every, h); i > 0; --i) {
      world.step();
      gap = std::max(gap, tip.gap().position);
    }
    const math::Vec3 now = math::rotate(body.com_pose().orientation, {0.0, 0.0, 1.0});
    tilt_error = std::max(tilt_error, std::abs(std::acos(now.z) - wanted[sample].tilt));
    const double heading = std::atan2(now.y, now.x);
    precession += std::remainder(heading - last, 2.0 * kPi);
    last = heading;
  }
  return {{"tilt, rad", tilt_error},
          {"precession, share", std::abs(precession / wanted.back().precession - 1.0)},
          {"gap, m", gap}};
}

// IFToMM A01: a point of 1 kg on a rod of 1 m without mass, let go from the horizontal.
Figures simple_pendulum(double h) {
  const double g = 9.81;
  World world(options(h, {0.0, 0.0, -g}));
  Body post(mass_only(0.0, {})), point(mass_only(1.0, {1e-6, 1e-6, 1e-6}, {{-1.0, 0.0, 0.0}, {}}));
  Joint hinge(joint_of(state::JointType::revolute, {}, {1.0, 0.0, 0.0}), post, point);
  for (Body* body : {&post, &point}) world.add(*body);
  world.add(hinge);
  const double every = 0.02;
  const auto wanted = swing(1.0 + 1e-6, g, kPi, 0.0, every, steps_in(kSeconds, every) + 1);
  double error = 0.0;
  for (std::size_t sample = 1; sample < wanted.size(); ++sample) {
    for (int i = steps_in(every, h); i > 0; --i) world.step();
    const math::Vec3 right{std::cos(wanted[sample]), 0.0, std::sin(wanted[sample])};
    error = std::max(error, math::norm(point.com_pose().position - right));
  }
  return {{"position, m", error}};
}

// IFToMM A02: 40 parallelograms in a row, links of 1 m and 1 kg, the first pivot moving at 1 m/s.
Figures ladder(double h) {
  constexpr int kLoops = 40;
  const double g = 9.81;
  World world(options(h, {0.0, 0.0, -g}));
  const math::Vec3 inertia{1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0};
  std::vector<std::unique_ptr<Body>> cranks, couplers;
  std::vector<std::unique_ptr<Joint>> joints;
  Body ground(mass_only(0.0, {}));
  world.add(ground);
  const auto link = [&](Body& a, const math::Vec3& at_a, Body& b, const math::Vec3& at_b) {
    joints.push_back(std::make_unique<Joint>(joint_of(state::JointType::revolute, at_a, at_b), a, b));
    world.add(*joints.back());
  };
  for (int i = 0; i <= kLoops; ++i) {
    const double x = i;
    cranks.push_back(std::make_unique<Body>(mass_only(1.0, inertia, {{x, 0.0, 0.5}, {}})));
    world.add(*cranks.back());
    cranks.back()->set_twist({{0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    link(ground, {x, 0.0, 0.0}, *cranks.back(), {0.0, 0.0, -0.5});
    if (i == 0) continue;
    couplers.push_back(std::make_unique<Body>(mass_only(1.0, inertia, {{x - 0.5, 0.0, 1.0}, {}})));
    world.add(*couplers.back());
    couplers.back()->set_twist({{1.0, 0.0, 0.0}, {}});
    link(*cranks[static_cast<std::size_t>(i) - 1], {0.0, 0.0, 0.5}, *couplers.back(), {-0.5, 0.0, 0.0});
    link(*couplers.back(), {0.5, 0.0, 0.0}, *cranks.back(), {0.0, 0.0, 0.5});
  }
  const double every = 0.02, bars = kLoops + 1.0;
  const auto wanted =
      swing(bars / 3.0 + kLoops, (bars / 2.0 + kLoops) * g, kPi / 2.0, -1.0, every, steps_in(kSeconds, every) + 1);
  double error = 0.0;
  for (std::size_t sample = 1; sample < wanted.size(); ++sample) {
    for (int i = steps_in(every, h); i > 0; --i) world.step();
    const math::Pose at = cranks[0]->pose();
    const math::Vec3 top = at.position + math::rotate(at.orientation, {0.0, 0.0, 0.5});
    error = std::max(error, math::norm(top - math::Vec3{std::cos(wanted[sample]), 0.0, std::sin(wanted[sample])}));
  }
  double gap = 0.0, energy = 0.0;
  for (const auto& joint : joints) gap = std::max(gap, joint->gap().position);
  for (auto* list : {&cranks, &couplers})
    for (const auto& body : *list) energy += energy_of(*body, g);
  const double start = bars * (0.5 / 3.0 + 0.5 * g) + kLoops * (0.5 + g);
  return {{"position, m", error}, {"gap, m", gap}, {"energy, share", energy / start - 1.0}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Case> cases = {
      {"tumbling box", tumbling_box},
      {"gyroscope", gyroscope},
      {"heavy top", heavy_top},
      {"simple pendulum A01", simple_pendulum},
      {"ladder A02", ladder},
      {"Bricard A04", bricard_mechanism},
      {"cradle", cradle},
      {"cube slides", sliding_cube},
      {"cube held", held_cube},
  };
  const std::vector<double> steps = {4e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4};
  for (const Case& item : cases) {
    if (argc > 1 && item.name.find(argv[1]) == std::string::npos) continue;
    std::vector<Figures> columns;
    std::printf("%-24s", item.name.c_str());
    for (const double h : steps) std::printf("%9g ms", 1e3 * h);
    std::printf("\n");
    for (const double h : steps) columns.push_back(item.run(h));
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
      std::printf("  %-22s", columns[0][i].name.c_str());
      for (const Figures& column : columns) std::printf("%12.2e", column[i].value);
      std::printf("\n");
    }
    std::fflush(stdout);
  }
  return 0;
}
