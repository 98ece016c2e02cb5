// Arms in the simulation: what their set-points ask of joints.
#include <any>

#include "crtk/arm_kind.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"

namespace ambf::crtk {
namespace {

using state::JointCommandType;

struct LiveArm final : model::LivePlaced {
  ArmMotion motion;
  bool drives = false;  // its joints follow it
};

struct SavedArm final : model::SavedPlaced {
  ArmMotion motion;
  bool drives = false;
};

// As built from a block; the slots of its joints are those of a structure.
struct ArmRow {
  ArmInfo info;
  std::vector<std::string> names;
};

constexpr std::uint64_t kMaxNumber = std::uint64_t{1} << 62;

void transfer_order(model::StateArchive& archive, Order& order) {
  archive.count(order.number, 0, kMaxNumber, "the number of an arm's order");
  archive.choice(order.mode, 0, static_cast<int>(Mode::effort), "the mode of an arm");
}

void transfer_axes(model::StateArchive& archive, Axes& axes, const char* what) {
  for (double& value : axes) archive.number(value, -1e9, 1e9, what);
}

void transfer_bits(model::StateArchive& archive, std::uint32_t& bits, const char* what) {
  std::uint64_t wide = bits;
  archive.count(wide, 0, 0xffffffffu, what);
  bits = static_cast<std::uint32_t>(wide);
}

void transfer_group(model::StateArchive& archive, GroupMotion& group) {
  transfer_order(archive, group.order);
  archive.flag(group.moves, "whether an arm moves");
  archive.flag(group.reached, "whether an arm got to its goal");
  archive.number(group.settling_s, 0.0, 1e3, "how long an arm settles");
}

struct JointNow {
  double position = 0.0, velocity = 0.0, effort = 0.0;
};

// Joints as measure() wants them.
struct JointsNow {
  const model::LiveWorld::Impl& live;
  JointNow operator[](std::uint32_t slot) const {
    const physics::Joint& joint = *live.tables.joints()[slot].joint;
    return {joint.position(), joint.velocity(), 0.0};
  }
};

class ArmModel final : public model::DescribedKind<ArmBlock> {
 public:
  ArmModel() : DescribedKind(arm_kind().kind, arm_blocks()) {}

  Made make(const ArmBlock& block) const override {
    ArmRow row;
    read_block(block, row.info, row.names);  // what is not of its form was dropped when the file was read
    return {std::make_unique<LiveArm>(), std::move(row), {}};
  }
  // Its joints may come and go: they are sought by name among those that the parent commands.
  void add_row(const model::Entry& entry, const model::StructureDraft& draft,
               state::Structure& structure) const override {
    const ArmRow& row = entry.row_as<ArmRow>();
    ArmInfo info = row.info;
    set_placed(info, entry, draft);
    if (info.parent_object != state::kNone) {
      const state::ObjectInfo& parent = structure.objects[info.parent_object];
      if (state::info_of(parent.kind).has_mass) {
        for (const std::uint32_t slot : structure.bodies[parent.slot].joints) {
          const std::string name = without_blanks(structure.joints[slot].name);
          for (std::size_t i = 0; i < info.joints.size(); ++i) {
            if (info.joints[i].slot == state::kNone && row.names[i] == name) info.joints[i].slot = slot;
          }
        }
      }
    }
    state::table<ArmInfo>(structure, number()).push_back(std::move(info));
  }

  bool accepts(const state::Command& command) const override {
    const auto* own = std::get_if<state::KindCommand>(&command);
    return own != nullptr && std::any_cast<ArmCommand>(&own->value) != nullptr;
  }
  bool obeys_in_step() const override { return true; }
  bool commands_outlive_reset() const override { return true; }

  bool merge(model::LiveWorld::Impl& live, std::uint32_t slot, const model::CommandSlots& slots) const override {
    const ArmCommand* newest = nullptr;
    std::uint64_t order = 0;
    slots.each([&](int, const model::CommandSlot& source) {
      if (!source.in_force || source.order < order) return;
      order = source.order;
      newest = std::any_cast<ArmCommand>(&std::get<state::KindCommand>(source.command()).value);
    });
    LiveArm& arm = self(live, slot);
    if (newest == nullptr) {
      let_go(live, slot, arm);
      return true;
    }
    obey(arm.motion, info(live, slot).limits, *newest, measured(live, slot));
    drive(live, slot, arm);
    return true;
  }
  void add_actors(model::LiveWorld::Impl& live) const override {
    // The joints' drives have acted already: what moves now is obeyed in the next step.
    live.actors.add(model::StepPhase::laws, "arms", [this, &live](double h_s) {
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot) {
        LiveArm& arm = self(live, slot);
        if (!arm.drives) continue;
        advance(arm.motion, info(live, slot).limits, measured(live, slot), h_s);
        drive(live, slot, arm);
      }
    });
  }

  void fill(const model::LiveWorld::Impl& live, state::Frame& frame) const override {
    auto& rows = state::rows(frame, arm_kind().column);
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      const LiveArm& arm = self(live, slot);
      rows[slot] = {{arm.T_parent, pose(live, slot), arm.active}, arm.motion};
    }
  }

  // Once physics is reset and the joints are idle again.
  void after_reset(model::LiveWorld::Impl& live, std::uint32_t slot) const override {
    LiveArm& arm = self(live, slot);
    start_afresh(arm.motion, info(live, slot).limits, measured(live, slot));
    if (arm.drives) drive(live, slot, arm);
  }

  std::unique_ptr<model::SavedObject> make_saved() const override { return std::make_unique<SavedArm>(); }
  void save(const model::LiveWorld::Impl& live, std::uint32_t slot, model::SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    static_cast<SavedArm&>(saved).motion = self(live, slot).motion;
    static_cast<SavedArm&>(saved).drives = self(live, slot).drives;
  }
  void transfer(model::StateArchive& archive, model::SavedObject& saved,
                const model::SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    ArmMotion& motion = static_cast<SavedArm&>(saved).motion;
    archive.flag(static_cast<SavedArm&>(saved).drives, "whether joints follow an arm");
    transfer_group(archive, motion.arm);
    transfer_group(archive, motion.jaw);
    transfer_axes(archive, motion.position, "a set-point of an arm");
    transfer_axes(archive, motion.velocity, "a speed of an arm");
    transfer_axes(archive, motion.goal, "a goal of an arm");
    transfer_axes(archive, motion.effort, "an effort of an arm");
    transfer_bits(archive, motion.efforts, "which axes exert efforts");
    archive.number(motion.ratio_velocity, 0.0, 1.0, "a ratio of speed");
    archive.number(motion.ratio_acceleration, 0.0, 1.0, "a ratio of acceleration");
    transfer_bits(archive, motion.note, "the note of an arm");
  }
  void transfer(model::StateArchive& archive, state::Command& command) const override {
    ArmCommand own;
    if (!archive.reads()) own = std::any_cast<ArmCommand>(std::get<state::KindCommand>(command).value);
    transfer_order(archive, own.arm);
    transfer_order(archive, own.jaw);
    transfer_axes(archive, own.values, "a commanded value of an arm");
    transfer_bits(archive, own.efforts, "which axes exert efforts");
    archive.number(own.ratio_velocity, 0.0, 1.0, "a ratio of speed");
    archive.number(own.ratio_acceleration, 0.0, 1.0, "a ratio of acceleration");
    transfer_bits(archive, own.note, "the note of an arm");
    if (archive.reads()) command = state::KindCommand{own};
  }
  void restore(model::LiveWorld::Impl& live, std::uint32_t slot, const model::SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    self(live, slot).motion = static_cast<const SavedArm&>(saved).motion;
    self(live, slot).drives = static_cast<const SavedArm&>(saved).drives;
  }

 private:
  LiveArm& self(const model::LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveArm&>(placed(live, slot));
  }
  const ArmInfo& info(const model::LiveWorld::Impl& live, std::uint32_t slot) const {
    return state::table<ArmInfo>(*live.structure, number())[slot];
  }
  Axes measured(const model::LiveWorld::Impl& live, std::uint32_t slot) const {
    Axes position, velocity, effort;
    measure(info(live, slot), JointsNow{live}, position, velocity, effort);
    return position;
  }

  static void set(model::LiveWorld::Impl& live, const MovedJoint& moved, JointCommandType type, double value) {
    model::LiveJoint& joint = live.tables.joints()[moved.slot];
    if (joint.joint->frozen()) return;
    if (joint.order.type != type) joint.controller.reset();
    joint.order = {type, value, nullptr};
  }

  // What is exerted nothing is let go once; else the newest set-points are the joints' orders.
  void drive(model::LiveWorld::Impl& live, std::uint32_t slot, LiveArm& arm) const {
    const ArmInfo& row = info(live, slot);
    const ArmMotion& motion = arm.motion;
    const bool keeps = row.whole() || (motion.note & kKeepsOthers) != 0;
    if (motion.arm.order.mode == Mode::off || !keeps) return let_go(live, slot, arm);
    arm.drives = true;
    Axes now{};
    const std::size_t jaw = row.limits.joints;
    const bool squeezes = row.limits.has_jaw && exerts(motion, row.limits, jaw);
    bool measured_now = false;
    bool pressing = false;  // the first half of a jaw keeps the wrist, the others press on it
    for (const MovedJoint& joint : row.joints) {
      if (joint.slot == state::kNone) continue;
      const bool effort = exerts(motion, row.limits, joint.axis);
      if (!joint.half_of_jaw) {
        if (effort) {
          set(live, joint, JointCommandType::effort, motion.effort[joint.axis] * joint.ratio);
        } else {
          set(live, joint, JointCommandType::position, joint.ratio * (motion.position[joint.axis] - joint.offset));
        }
        continue;
      }
      if ((effort || squeezes) && !measured_now) {
        now = measured(live, slot);
        measured_now = true;
      }
      if (effort && squeezes) {
        set(live, joint, JointCommandType::effort, 0.5 * joint.ratio * motion.effort[joint.axis] + motion.effort[jaw]);
      } else if (squeezes && pressing) {
        set(live, joint, JointCommandType::effort, motion.effort[jaw]);
      } else {
        const double yaw = effort ? now[joint.axis] : motion.position[joint.axis];
        const double opening = squeezes ? now[jaw] : motion.position[jaw];
        set(live, joint, JointCommandType::position, joint.ratio * yaw + 0.5 * opening);
      }
      pressing = true;
    }
  }

  // Joints that another command leads already are left to it.
  void let_go(model::LiveWorld::Impl& live, std::uint32_t slot, LiveArm& arm) const {
    if (!arm.drives) return;
    arm.drives = false;
    for (const MovedJoint& moved : info(live, slot).joints) {
      if (moved.slot == state::kNone) continue;
      model::LiveJoint& joint = live.tables.joints()[moved.slot];
      if (joint.order.led != nullptr || joint.order.jaw != nullptr) continue;
      joint.order = {JointCommandType::effort, 0.0, nullptr};
      joint.controller.reset();
    }
  }
};

}  // namespace

void register_arms() {
  static const bool once = [] {
    model::register_kind(std::make_unique<ArmModel>());
    return true;
  }();
  (void)once;
}

}  // namespace ambf::crtk
