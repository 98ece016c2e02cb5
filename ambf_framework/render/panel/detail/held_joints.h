// Joints that the panel holds: the simulation keeps a set value in force until it is released, however slowly pictures
// come. A released joint follows other sources, or goes limp. Main thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "state/abilities/command.h"

namespace ambf::render {

class HeldJoints {
 public:
  explicit HeldJoints(state::CommandAbility& command) : command_(command) {}
  ~HeldJoints() { release_all(); }

  // Why `joint` (a slot) cannot be commanded, or empty.
  static std::string refusal(const state::Structure& structure, std::uint32_t joint);

  // Holds it at a position (rad or m), velocity or effort (Nm or N). Returns why not, or nothing.
  std::string hold(const state::Structure& structure, std::uint32_t joint, const state::JointCommand& command);
  void release(const state::Structure& structure, std::uint32_t joint);
  void release_all();

  std::optional<state::JointCommand> held(const state::Structure& structure, std::uint32_t joint) const;
  bool any() const { return !bodies_.empty(); }

  // Once a picture. Releases what is gone from the structure, and everything when the world went back in time (reset,
  // restore). Returns a message about it for the user, or nothing.
  std::string follow(const state::Frame& frame, std::int64_t now_ns);

 private:
  // The commands of the joints below one body go through one port, as through one topic.
  struct Body {
    std::unique_ptr<state::CommandPort> port;
    std::map<std::uint64_t, state::JointCommand> joints;  // by joint's id
    std::int64_t posted_ns = 0;
  };
  static constexpr std::uint64_t kNobody = ~std::uint64_t{0};
  static std::uint64_t key_of(state::ObjectId id) { return (std::uint64_t{id.generation} << 32) | id.index; }
  static std::uint64_t key_of(const state::Structure& structure, std::uint32_t joint);
  static std::uint32_t joint_of(const state::Structure& structure, std::uint64_t key);  // its slot
  void post(const state::Structure& structure, std::uint32_t body, Body& held, std::uint64_t let_go) const;
  void drop_what_is_gone(const state::Structure& structure);
  std::string joint_count() const;  // "2 joints are"

  state::CommandAbility& command_;
  std::map<std::uint64_t, Body> bodies_;  // by body's id
  std::uint64_t structure_version_ = 0, epoch_ = 0;
  std::uint32_t sim_step_ = 0;
  std::int64_t now_ns_ = 0;
};

}  // namespace ambf::render
