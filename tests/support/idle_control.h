// A state::Control that does nothing: tests override what they are about, and a new function of Control is added in this one place.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "state/control.h"

namespace ambf::testing {

class IdleControl : public state::Control {
 public:
  std::unique_ptr<state::FrameReader> make_reader() override { return nullptr; }
  std::shared_ptr<const state::Structure> structure() override { return nullptr; }
  std::unique_ptr<state::CommandPort> bind(state::ObjectId, state::Source) override { return nullptr; }
  void post_world(const state::WorldCommand&) override {}
  void world_command_expired() override {}
  void count_refused_command(state::ObjectId) override {}
  void report_graphics(double, double) override {}
  void report_comm(double) override {}
  void set_paused(bool) override {}
  void step_paused(unsigned) override {}
  void reset_world() override {}
  void reset_bodies() override {}
  void reset_bodies(std::vector<state::ObjectId>) override {}
  void set_speed(double) override {}
  void set_parameter(state::ObjectId, state::Parameter, const math::Vec3&, state::Completion) override {}
  void push(state::ObjectId, const state::Push&, state::Completion) override {}
  void set_gravity(const math::Vec3&) override {}
  void set_lens(state::ObjectId, const state::Lens&) override {}
  void set_beam(state::ObjectId, const state::Beam&) override {}
  void set_parent(state::ObjectId, const std::string&, state::Completion) override {}
  std::unique_ptr<state::StepTicket> step(unsigned, std::vector<state::AddressedCommand>, bool) override {
    return nullptr;
  }
  void load(state::LoadRequest, state::Completion) override {}
  void unload(const std::string&, state::Completion) override {}
  void remove(const std::string&, state::Completion) override {}
  void snapshot(const std::string&, const std::string&, state::Completion) override {}
  void restore(const std::string&, const std::string&, state::Completion) override {}
  std::vector<std::string> snapshots() override { return {}; }
  std::unique_ptr<state::PickPort> make_pick_port() override { return nullptr; }
};

}  // namespace ambf::testing
