// A Control without a simulation: notes what was asked of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "state/control.h"

namespace ambf::render::testing {

class FakeControl final : public state::Control {
 public:
  struct Posted {
    state::ObjectId object;
    state::PoseCommand command;
  };
  std::vector<Posted> posted;
  int released = 0, picks = 0, ended = 0;
  math::Vec3 from, to;
  std::vector<math::Vec3> dragged;
  std::function<void(bool, const state::PickHit&)> answer;
  std::uint32_t pointers = 0;
  bool no_pointers = false;

  class Port final : public state::CommandPort {
   public:
    Port(FakeControl& control, state::ObjectId object) : control_(control), object_(object) {}
    void post(const state::Command& c) override {
      control_.posted.push_back({object_, std::get<state::PoseCommand>(c)});
    }
    void keep_alive() override {}
    void release() override { ++control_.released; }

   private:
    FakeControl& control_;
    state::ObjectId object_;
  };

  std::unique_ptr<state::FrameReader> make_reader() override { return nullptr; }
  std::shared_ptr<const state::Structure> structure() override { return nullptr; }
  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source) override {
    return std::make_unique<Port>(*this, object);
  }
  void post_world(const state::WorldCommand&) override {}
  void world_command_expired() override {}
  void count_refused_command() override {}
  void report_graphics_rate(double) override {}
  void set_paused(bool) override {}
  void step_paused(unsigned) override {}
  void reset_world() override {}
  void reset_bodies() override {}
  void reset_bodies(std::vector<state::ObjectId>) override {}
  void set_speed(double) override {}
  void set_parameter(state::ObjectId, state::Parameter, const math::Vec3&, state::Completion) override {}
  void push(state::ObjectId, const state::Push&, state::Completion) override {}
  void set_gravity(const math::Vec3&) override {}
  void step(unsigned, std::vector<state::AddressedCommand>, state::Completion) override {}
  void load(state::LoadRequest, state::Completion) override {}
  void unload(const std::string&, state::Completion) override {}
  void remove(const std::string&, state::Completion) override {}
  void snapshot(const std::string&, const std::string&, state::Completion) override {}
  void restore(const std::string&, const std::string&, state::Completion) override {}
  std::vector<std::string> snapshots() override { return {}; }
  class Pointer final : public state::PickPort {
   public:
    explicit Pointer(FakeControl& control) : control_(control), id_(control.pointers++) {}
    std::uint32_t id() const override { return id_; }
    void pick(const math::Vec3& a, const math::Vec3& b,
              std::function<void(bool, const state::PickHit&)> done) override {
      ++control_.picks;
      control_.from = a;
      control_.to = b;
      control_.answer = std::move(done);
    }
    void drag(const math::Vec3& target) override { control_.dragged.push_back(target); }
    void release() override { ++control_.ended; }

   private:
    FakeControl& control_;
    std::uint32_t id_;
  };
  std::unique_ptr<state::PickPort> make_pick_port() override {
    return no_pointers ? nullptr : std::make_unique<Pointer>(*this);
  }
};

}  // namespace ambf::render::testing
