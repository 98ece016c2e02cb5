// Sinusoids for every active joint of what a rig has loaded, as the bars on joint gaps ask: 0.2 x a joint's range at
// 0.5 Hz, position commands in every step. One thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "tests/runtime/model_rig.h"

namespace ambf::runtime::test {

class JointMotion {
 public:
  static constexpr double kFrequencyHz = 0.5;
  static constexpr double kShare = 0.2;    // amplitude over range; an endless joint's range is one turn
  static constexpr double kBlend_s = 1.0;  // from where the joint is to where the sinusoid is

  explicit JointMotion(ModelRig& rig) {
    const auto structure = rig.simulation.structure();
    const state::Frame& frame = rig.frame();
    for (std::uint32_t slot = 0; slot < structure->joints.size(); ++slot) {
      const state::JointInfo& info = structure->joints[slot];
      if (info.passive || !has_coordinate(info.type)) continue;
      const double range = info.has_limits ? info.upper - info.lower : 2.0 * std::numbers::pi;
      Wave wave;
      wave.from = frame.joints[slot].position;
      wave.amplitude = kShare * range;
      wave.middle =
          info.has_limits ? std::clamp(wave.from, info.lower + wave.amplitude, info.upper - wave.amplitude) : wave.from;
      wave.phase = 2.0 * std::numbers::pi * std::fmod(0.618034 * static_cast<double>(waves_.size()), 1.0);
      waves_[slot] = wave;
    }
    // Each through the body highest up that lists it, so that no joint is commanded twice.
    std::map<std::uint32_t, bool> taken;
    for (std::size_t round = 0; round < structure->bodies.size(); ++round) {
      std::uint32_t best = state::kNone;
      std::size_t most = 0;
      for (std::uint32_t body = 0; body < structure->bodies.size(); ++body) {
        std::size_t fresh = 0;
        for (const std::uint32_t joint : structure->bodies[body].joints)
          fresh += waves_.contains(joint) && !taken[joint];
        if (fresh > most) most = fresh, best = body;
      }
      if (best == state::kNone) break;
      Talk talk{structure->objects[structure->bodies[best].object].id, structure->bodies[best].joints, {}};
      for (const std::uint32_t joint : talk.joints) {
        talk.ours.push_back(waves_.contains(joint) && !taken[joint]);
        taken[joint] = true;
      }
      talks_.push_back(talk);
    }
  }

  std::size_t joint_count() const { return waves_.size(); }

  std::vector<state::AddressedCommand> at(double t_s) const {
    std::vector<state::AddressedCommand> commands;
    for (const Talk& talk : talks_) {
      state::RigidBodyCommand command;
      command.joints.resize(talk.joints.size());
      for (std::size_t i = 0; i < talk.joints.size(); ++i)
        if (talk.ours[i])
          command.joints[i] = {state::JointCommandType::position, value(waves_.at(talk.joints[i]), t_s)};
      commands.push_back({talk.body, command});
    }
    return commands;
  }
  // What the joints really did. Call it in every step.
  void note(const state::Frame& frame) {
    for (auto& [slot, wave] : waves_) {
      wave.low = std::min(wave.low, frame.joints[slot].position);
      wave.high = std::max(wave.high, frame.joints[slot].position);
    }
  }
  // Share of the joints that went at least half as far as their sinusoids ask for. (Joints that a loop couples cannot
  // all obey.)
  double share_that_moved() const {
    double moved = 0.0;
    for (const auto& [slot, wave] : waves_) moved += wave.high - wave.low >= wave.amplitude;
    return moved / static_cast<double>(waves_.size());
  }

 private:
  struct Wave {
    double from = 0.0, middle = 0.0, amplitude = 0.0, phase = 0.0;
    double low = 1e9, high = -1e9;  // measured
  };
  struct Talk {
    state::ObjectId body;
    state::IndexList joints;
    std::vector<bool> ours;
  };

  static bool has_coordinate(state::JointType type) {
    return type == state::JointType::revolute || type == state::JointType::prismatic;
  }
  static double value(const Wave& wave, double t_s) {
    const double wanted =
        wave.middle + wave.amplitude * std::sin(2.0 * std::numbers::pi * kFrequencyHz * t_s + wave.phase);
    const double u = std::min(t_s / kBlend_s, 1.0);
    return wave.from + u * u * (3.0 - 2.0 * u) * (wanted - wave.from);
  }

  std::map<std::uint32_t, Wave> waves_;
  std::vector<Talk> talks_;
};

}  // namespace ambf::runtime::test
