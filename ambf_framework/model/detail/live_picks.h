// The bodies that pointers hold. A moving one is pulled by a spring, a static one moved; while the world stands still
// both are moved; of a soft body a face is pulled. Physics thread; nothing here allocates. Inside model/ only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/detail/live_objects.h"
#include "model/pick_table.h"
#include "physics/soft_grip.h"
#include "physics/world.h"
#include "state/frame.h"

namespace ambf::inputs {
class Channel;  // inputs/recorder.h
}

namespace ambf::model {

class LivePicks {
 public:
  explicit LivePicks(physics::World& world) : world_(world) {}
  PickTable& table() { return table_; }
  void record_to(inputs::Channel* channel) { record_ = channel; }

  // Before a structure is put in force: for what moves along with a held body.
  void reserve(std::size_t bodies) { moving_along_.reserve(bodies); }

  // The pointer of this slot holds the body by this point from now on, unless that press has ended already.
  void hold(std::size_t slot, std::uint64_t press, LiveBody& live, const math::Vec3& point_world);
  void hold(std::size_t slot, std::uint64_t press, physics::SoftBody& body, const physics::SoftRayHit& where);
  // Follows targets, ends what was let go. `still`: no step will follow for now. True when a frame would show a
  // difference.
  bool take(const state::Structure& structure, const TypedTable<LiveBody>& bodies, bool still);
  // After a step: the pulls of that step.
  void report(Laws& laws, const TypedTable<LiveBody>& bodies) const;
  void end_of(const physics::Body& body);
  void end_all();
  void fill(state::Frame& frame) const;

 private:
  struct Held {
    std::uint64_t press = 0;
    physics::Body* body = nullptr;      // null: no rigid one
    physics::SoftBody* soft = nullptr;  // null: no soft one
    math::Vec3 point_body, target_world;
    int pull = -1;       // static bodies have none
    bool pulls = false;  // its force is that of the last step
  };
  physics::SoftGrip& grip_of(const Held& held) { return grips_[static_cast<std::size_t>(&held - held_.data())]; }
  void end(Held& held);
  bool has_ended(std::size_t slot, std::uint64_t press) const;
  void move_still(Held& held, const state::Structure& structure, const TypedTable<LiveBody>& bodies);

  physics::World& world_;
  PickTable table_;
  std::array<Held, base::kMaxPicks> held_;
  std::array<physics::SoftGrip, base::kMaxPicks> grips_;  // of soft bodies
  std::vector<std::uint8_t> moving_along_;                // by slot of the body
  inputs::Channel* record_ = nullptr;
};

}  // namespace ambf::model
