// A Control without a simulation: notes what was asked of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "state/control.h"
#include "tests/support/idle_control.h"

namespace ambf::render::testing {

class FakeControl final : public ambf::testing::IdleControl {
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
      if (const auto* pose = std::get_if<state::PoseCommand>(&c)) control_.posted.push_back({object_, *pose});
    }
    void post(const state::Command& c, std::int64_t) override { post(c); }
    void keep_alive() override {}
    void release() override { ++control_.released; }

   private:
    FakeControl& control_;
    state::ObjectId object_;
  };

  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source) override {
    return std::make_unique<Port>(*this, object);
  }
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
