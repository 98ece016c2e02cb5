// Abilities without a simulation: they record their calls.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "state/abilities/command.h"
#include "state/abilities/pick.h"
#include "state/abilities/tune.h"

namespace ambf::render::testing {

class FakeAbilities final : public state::CommandAbility, public state::PickAbility, public state::TuneAbility {
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
    Port(FakeAbilities& fake, state::ObjectId object) : fake_(fake), object_(object) {}
    void post(const state::Command& c) override {
      if (const auto* pose = std::get_if<state::PoseCommand>(&c)) fake_.posted.push_back({object_, *pose});
    }
    void post(const state::Command& c, std::int64_t) override { post(c); }
    void keep_alive() override {}
    void hold() override {}
    void release() override { ++fake_.released; }

   private:
    FakeAbilities& fake_;
    state::ObjectId object_;
  };

  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source) override {
    return std::make_unique<Port>(*this, object);
  }
  void count_refused_command(state::ObjectId) override {}
  void push(state::ObjectId, const state::Push&, state::Completion) override {}
  void set_gravity(const math::Vec3&) override {}
  void set_parameter(state::ObjectId, state::Parameter, const math::Vec3&, state::Completion) override {}
  void set_hold(state::ObjectId, bool, state::Completion) override {}
  void set_lens(state::ObjectId, const state::Lens&) override {}
  void set_beam(state::ObjectId, const state::Beam&) override {}
  class Pointer final : public state::PickPort {
   public:
    explicit Pointer(FakeAbilities& fake) : fake_(fake), id_(fake.pointers++) {}
    std::uint32_t id() const override { return id_; }
    void pick(const math::Vec3& a, const math::Vec3& b,
              std::function<void(bool, const state::PickHit&)> done) override {
      ++fake_.picks;
      fake_.from = a;
      fake_.to = b;
      fake_.answer = std::move(done);
    }
    void drag(const math::Vec3& target) override { fake_.dragged.push_back(target); }
    void release() override { ++fake_.ended; }

   private:
    FakeAbilities& fake_;
    std::uint32_t id_;
  };
  std::unique_ptr<state::PickPort> make_pick_port() override {
    return no_pointers ? nullptr : std::make_unique<Pointer>(*this);
  }
};

}  // namespace ambf::render::testing
