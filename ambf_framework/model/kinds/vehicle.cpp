// Vehicles: they hang on their chassis, which physics::Wheels carries, and place the bodies that are its wheels. A
// wheel whose body is not there yet carries nothing; a vehicle whose chassis is not a body that moves does nothing.
#include <algorithm>
#include <any>

#include "base/bounds.h"
#include "math/rotation.h"
#include "model/detail/command_bounds.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "model/kinds/vehicle/detail/live_vehicle.h"
#include "physics/mounted_bodies.h"
#include "scene/vehicle.h"
#include "state/vehicles.h"

namespace ambf::model {
namespace {

using state::ObjectKind;
using state::VehicleCommand;

// The memory of tyres and wheels in snapshots.
constexpr double kMaxStretch_m = 1e6, kMaxRate = 1e9, kMaxAngle = 1e3;

const VehicleCommand& command_of(const state::Command& command) {
  return std::any_cast<const VehicleCommand&>(std::get<state::KindCommand>(command).value);
}

// What a row of the catalogue holds.
struct VehicleRow {
  state::VehicleInfo info;
  std::vector<std::string> bodies;     // of the wheels, as written
  std::vector<state::ObjectId> drawn;  // bodies that were made of the wheels' meshes
};

struct SavedVehicle final : SavedPlaced {
  bool handbrake = false;
  std::vector<physics::WheelMotion> motions;
};

class VehicleKind final : public PlacedKind {
 public:
  VehicleKind() : PlacedKind(state::vehicle_kind().kind) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    each_block(model.description,
               [&](const scene::KindBlock& block) { load_vehicle(all, block, model, options, findings); });
  }
  void erase_block(scene::Model& model, const std::string& identifier) const override {
    std::erase_if(model.blocks, [&](const scene::KindBlock& block) {
      return block.kind == &scene::kind::kVehicle && block.identity.identifier == identifier;
    });
  }
  void each_parent(const scene::Model& model, const ParentVisit& visit) const override {
    each_block(model, [&](const scene::KindBlock& block) { visit(block.identity, block.as<scene::Vehicle>().parent); });
  }
  std::vector<state::ObjectId> belongings(const Entry& entry) const override {
    return entry.row_as<VehicleRow>().drawn;
  }
  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    const VehicleRow& row = entry.row_as<VehicleRow>();
    state::VehicleInfo info = row.info;
    set_placed(info, entry, draft);
    auto& rows = state::table<state::VehicleInfo>(structure, number());
    if (!rows.empty())
      info.first_wheel = rows.back().first_wheel + static_cast<std::uint32_t>(rows.back().wheels.size());
    for (std::size_t i = 0; i < row.bodies.size(); ++i) {
      const std::uint32_t body = find_body(structure, entry, row.bodies[i]);
      if (body != state::kNone && !is_taken(rows, info, i, body, structure)) info.wheels[i].body = body;
    }
    rows.push_back(std::move(info));
  }

  // Bodies may have come, gone or become wheels of others.
  void link(LiveWorld::Impl& live, std::uint32_t slot, bool) const override {
    self(live, slot).wheels.forget();
    if (slot + 1 < live.tables.of(number()).size()) return;
    std::vector<bool> is_wheel(live.structure->bodies.size(), false);
    for (std::uint32_t each = 0; each <= slot; ++each) {
      if (chassis_of(live, each) == nullptr) continue;
      for (const state::VehicleWheel& wheel : state::vehicles(*live.structure)[each].wheels)
        if (wheel.body != state::kNone) is_wheel[wheel.body] = true;
    }
    for (std::uint32_t slot_of = 0; slot_of < is_wheel.size(); ++slot_of) {
      LiveBody& body = live.tables.bodies()[slot_of];
      if (is_wheel[slot_of] && !physics::is_mounted(*body.body)) {
        live.picks.end_of(*body.body);
        live.effectors.end_of(body);
      }
      physics::set_mounted(*body.body, is_wheel[slot_of]);
    }
    for (std::uint32_t each = 0; each <= slot; ++each) self(live, each).settle(live, each);
  }
  void unlink(LiveWorld::Impl& live, std::uint32_t slot) const override {
    for (const state::VehicleWheel& wheel : state::vehicles(*live.structure)[slot].wheels)
      if (wheel.body != state::kNone) physics::set_mounted(*live.tables.bodies()[wheel.body].body, false);
  }

  bool accepts(const state::Command& command) const override {
    const auto* own = std::get_if<state::KindCommand>(&command);
    return own != nullptr && std::any_cast<VehicleCommand>(&own->value) != nullptr;
  }
  bool obeys_in_step() const override { return true; }
  void release_frozen(LiveWorld::Impl& live, std::uint32_t slot, const state::Command& command) const override {
    physics::Body* chassis = chassis_of(live, slot);
    if (chassis == nullptr || !chassis->frozen()) return;
    CommandBound bound(live.tables.bodies()[chassis->user_index()], live.physics->options().step);
    bound.wrench(command_of(command).wrench_world);
    if (!bound.cut()) live.physics->release_frozen(*chassis);
  }
  bool merge(LiveWorld::Impl& live, std::uint32_t slot, const CommandSlots& slots) const override {
    LiveVehicle& vehicle = self(live, slot);
    std::uint64_t newest = 0;
    vehicle.want_nothing();
    slots.each([&](int, const CommandSlot& source) {
      if (!source.in_force || source.order < newest) return;
      newest = source.order;
      vehicle.want(command_of(source.command()), state::vehicles(*live.structure)[slot]);
    });
    return false;
  }

  void add_actors(LiveWorld::Impl& live) const override {
    live.actors.add(StepPhase::forces, "vehicles", [this, &live](double h_s) {
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot)
        self(live, slot).act(live, slot, h_s);
    });
    live.actors.add(StepPhase::readings, "wheels", [this, &live](double) {
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot) self(live, slot).follow(live, slot);
    });
  }

  // The chassis itself, wherever the vehicle hung when it was given this one.
  math::Pose pose(const LiveWorld::Impl& live, std::uint32_t slot) const override {
    const physics::Body* chassis = chassis_of(live, slot);
    return chassis == nullptr ? PlacedKind::pose(live, slot) : chassis->pose();
  }
  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    auto& rows = state::rows(frame, state::vehicle_kind().column);
    auto& wheels = state::vehicle_wheels(frame);
    const auto& infos = state::vehicles(*live.structure);
    wheels.resize(infos.empty() ? 0 : infos.back().first_wheel + infos.back().wheels.size());
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      const LiveVehicle& vehicle = self(live, slot);
      const physics::Body* chassis = chassis_of(live, slot);
      rows[slot] = {{chassis == nullptr ? vehicle.T_parent : math::Pose{}, pose(live, slot), vehicle.active},
                    0.0,
                    vehicle.handbrake};
      if (chassis != nullptr) {
        const physics::Wheel& first = vehicle.wheels.wheel(0);
        const math::Vec3 ahead = math::normalized(math::cross(-first.down, first.axle));
        rows[slot].speed = math::dot(chassis->twist().linear, math::rotate(chassis->com_pose().orientation, ahead));
      }
      const math::Pose T_body_com = chassis == nullptr ? math::Pose{} : chassis->T_body_com();
      for (std::size_t i = 0; i < vehicle.wheels.size(); ++i)
        wheels[infos[slot].first_wheel + i] = vehicle.wheel_state(i, infos[slot].wheels[i], T_body_com);
    }
  }

  // Physics has put the bodies back.
  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    PlacedKind::reset(live, slot);
    self(live, slot).handbrake = false;
    bodies_reset(live, slot);
  }
  void bodies_reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    self(live, slot).wheels.reset();
    self(live, slot).settle(live, slot);
  }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedVehicle>(); }
  // The world that goes on stands on its wheels as the one that is restored: both look anew.
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    auto& to = static_cast<SavedVehicle&>(saved);
    LiveVehicle& vehicle = self(live, slot);
    to.handbrake = vehicle.handbrake;
    to.motions = vehicle.wheels.motions();
    vehicle.wheels.forget();
    self(live, slot).settle(live, slot);
  }
  using PlacedKind::transfer;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    auto& vehicle = static_cast<SavedVehicle&>(saved);
    archive.flag(vehicle.handbrake, "whether the handbrake is on");
    if (archive.reads()) vehicle.motions.resize(state::vehicles(context.structure)[context.slot].wheels.size());
    for (physics::WheelMotion& motion : vehicle.motions) {
      archive.number(motion.steering, -kMaxAngle, kMaxAngle, "where a wheel steers");
      archive.number(motion.angle, -kMaxAngle, kMaxAngle, "how far a wheel has turned");
      archive.number(motion.rate, -kMaxRate, kMaxRate, "how fast a wheel turns");
      archive.number(motion.stretch_forward, -kMaxStretch_m, kMaxStretch_m, "how far a tyre has given way");
      archive.number(motion.stretch_side, -kMaxStretch_m, kMaxStretch_m, "how far a tyre has given way");
    }
  }
  void transfer(StateArchive& archive, state::Command& command) const override {
    VehicleCommand own;
    if (!archive.reads()) own = command_of(command);
    transfer_vector(archive, own.wrench_world.force, base::kMaxForce, "a force on a chassis");
    transfer_vector(archive, own.wrench_world.torque, base::kMaxForce, "a torque on a chassis");
    for (std::vector<double>* values : {&own.steering, &own.drive, &own.brake}) {
      archive.size(*values, state::kMaxWheels, sizeof(double), "the number of commanded wheels");
      for (double& value : *values) archive.number(value, -base::kMaxForce, base::kMaxForce, "a wheel's command");
    }
    archive.flag(own.handbrake, "whether the handbrake is commanded");
    if (archive.reads()) command = state::KindCommand{std::move(own)};
  }
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    const auto& from = static_cast<const SavedVehicle&>(saved);
    LiveVehicle& vehicle = self(live, slot);
    vehicle.handbrake = from.handbrake;
    vehicle.wheels.reset();
    vehicle.wheels.motions() = from.motions;
    self(live, slot).settle(live, slot);
  }

 private:
  LiveVehicle& self(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveVehicle&>(placed(live, slot));
  }
  template <class Visit>
  static void each_block(const scene::Model& model, Visit visit) {
    for (const scene::KindBlock& block : model.blocks)
      if (block.kind == &scene::kind::kVehicle) visit(block);
  }

  // Exactly that body of the same file, whose identifier may end in a number of its own; else what the text means in
  // the world; state::kNone: nothing yet.
  static std::uint32_t find_body(const state::Structure& structure, const Entry& entry, const std::string& name) {
    const std::string own = entry.name_space + name;
    std::uint32_t numbered = state::kNone;
    for (const state::ObjectInfo& object : structure.objects) {
      if (object.kind != ObjectKind::rigid_body || object.model != entry.info.model) continue;
      if (object.identifier == own) return object.slot;
      const bool ends_in_number = object.identifier.starts_with(own) &&
                                  object.identifier.find_first_not_of("0123456789", own.size()) == std::string::npos;
      if (ends_in_number && numbered == state::kNone) numbered = object.slot;
    }
    if (numbered != state::kNone) return numbered;
    const std::uint32_t found = state::find(structure, name, ObjectKind::rigid_body);
    return found == state::kNone ? state::kNone : structure.objects[found].slot;
  }
  // Whether the body is the chassis, a wheel of another vehicle, or one of the first `count` wheels of this one.
  static bool is_taken(const std::vector<state::VehicleInfo>& others, const state::VehicleInfo& own, std::size_t count,
                       std::uint32_t body, const state::Structure& structure) {
    const auto is_it = [body](const state::VehicleWheel& wheel) { return wheel.body == body; };
    for (const state::VehicleInfo& other : others)
      if (std::any_of(other.wheels.begin(), other.wheels.end(), is_it)) return true;
    if (std::any_of(own.wheels.begin(), own.wheels.begin() + static_cast<std::ptrdiff_t>(count), is_it)) return true;
    if (own.parent_object == state::kNone) return false;
    const state::ObjectInfo& chassis = structure.objects[own.parent_object];
    return chassis.kind == ObjectKind::rigid_body && chassis.slot == body;
  }

  void load_vehicle(Catalogue::Impl& all, const scene::KindBlock& block, const LoadedModel& model,
                    const LoadOptions& options, Findings& findings) const {
    const auto& described = block.as<scene::Vehicle>();
    VehicleRow row;
    std::vector<physics::Wheel> wheels;
    for (const scene::Wheel& wheel : described.wheels) {
      wheels.push_back({wheel.connection, wheel.down, wheel.axle, wheel.radius_m, wheel.rest_length_m, wheel.stiffness,
                        wheel.compression, wheel.damping, wheel.friction, wheel.roll_influence});
      row.info.wheels.push_back({state::kNone, wheel.front, wheel.radius_m, wheel.steering_low, wheel.steering_high,
                                 wheel.max_drive_N, wheel.max_brake_N});
      row.bodies.push_back(wheel.body);
    }
    Entry* entry = add(all, std::make_unique<LiveVehicle>(std::move(wheels)), block.identity, described.parent, {},
                       model, options, findings);
    if (entry == nullptr) return;
    for (const scene::Wheel& wheel : described.wheels) {
      const auto own = all.loaded_bodies.find(entry->name_space + wheel.body);
      if (!wheel.mesh.empty() && own != all.loaded_bodies.end()) row.drawn.push_back(own->second->info.id);
      if (own == all.loaded_bodies.end() && all.find_parent(*entry, wheel.body) == nullptr)
        findings.information(block.identity, "wheels", "there is no body \"" + wheel.body + "\" yet",
                             "the wheel carries nothing until it comes");
    }
    entry->row = std::move(row);
  }
};

}  // namespace

std::unique_ptr<Kind> make_vehicle_kind() { return std::make_unique<VehicleKind>(); }

}  // namespace ambf::model
