// Beacons in the simulation.
#include <any>

#include "beacon.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"

namespace ambf::test {
namespace {

struct LiveBeacon final : model::LivePlaced {
  double phase = 0.0;
  double rate_hz = 1.0;
};

struct SavedBeacon final : model::SavedPlaced {
  double phase = 0.0;
  double rate_hz = 1.0;
};

class BeaconModel final : public model::DescribedKind<Beacon> {
 public:
  BeaconModel() : DescribedKind(beacon_kind().kind, beacon_blocks()) {}

  Made make(const Beacon& beacon) const override {
    auto live = std::make_unique<LiveBeacon>();
    live->rate_hz = beacon.rate_hz;
    BeaconInfo row;
    row.rate_hz = beacon.rate_hz;
    return {std::move(live), std::move(row), {beacon.position, {}}};
  }
  void add_row(const model::Entry& entry, const model::StructureDraft& draft,
               state::Structure& structure) const override {
    BeaconInfo row = entry.row_as<BeaconInfo>();
    set_placed(row, entry, draft);
    state::table<BeaconInfo>(structure, number()).push_back(std::move(row));
  }

  bool accepts(const state::Command& command) const override {
    const auto* own = std::get_if<state::KindCommand>(&command);
    return own != nullptr && std::any_cast<BeaconCommand>(&own->value) != nullptr;
  }
  bool merge(model::LiveWorld::Impl& live, std::uint32_t slot, const model::CommandSlots& slots) const override {
    LiveBeacon& beacon = self(live, slot);
    const double before = beacon.rate_hz;
    std::uint64_t newest = 0;
    slots.each([&](int, const model::CommandSlot& source) {
      if (!source.in_force || source.order < newest) return;
      newest = source.order;
      beacon.rate_hz =
          std::any_cast<const BeaconCommand&>(std::get<state::KindCommand>(source.command()).value).rate_hz;
    });
    return beacon.rate_hz != before;
  }
  void add_actors(model::LiveWorld::Impl& live) const override {
    live.actors.add(model::StepPhase::readings, "beacons", [this, &live](double h_s) {
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot)
        self(live, slot).phase += h_s * self(live, slot).rate_hz;
    });
  }

  void fill(const model::LiveWorld::Impl& live, state::Frame& frame) const override {
    auto& rows = state::rows(frame, beacon_kind().column);
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      const LiveBeacon& beacon = self(live, slot);
      rows[slot] = {{beacon.T_parent, pose(live, slot), beacon.active}, beacon.phase, beacon.rate_hz};
    }
  }
  void reset(model::LiveWorld::Impl& live, std::uint32_t slot) const override {
    PlacedKind::reset(live, slot);
    self(live, slot).phase = 0.0;
    self(live, slot).rate_hz = state::table<BeaconInfo>(*live.structure, number())[slot].rate_hz;
  }

  std::unique_ptr<model::SavedObject> make_saved() const override { return std::make_unique<SavedBeacon>(); }
  void save(const model::LiveWorld::Impl& live, std::uint32_t slot, model::SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    static_cast<SavedBeacon&>(saved).phase = self(live, slot).phase;
    static_cast<SavedBeacon&>(saved).rate_hz = self(live, slot).rate_hz;
  }
  void transfer(model::StateArchive& archive, model::SavedObject& saved,
                const model::SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    archive.number(static_cast<SavedBeacon&>(saved).phase, 0.0, 1e9, "the phase");
    archive.number(static_cast<SavedBeacon&>(saved).rate_hz, 0.0, kMaxBeaconRate_hz, "the rate");
  }
  void transfer(model::StateArchive& archive, state::Command& command) const override {
    BeaconCommand own;
    if (!archive.reads()) own = std::any_cast<BeaconCommand>(std::get<state::KindCommand>(command).value);
    archive.number(own.rate_hz, 0.0, kMaxBeaconRate_hz, "the commanded rate");
    if (archive.reads()) command = state::KindCommand{own};
  }
  void restore(model::LiveWorld::Impl& live, std::uint32_t slot, const model::SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    self(live, slot).phase = static_cast<const SavedBeacon&>(saved).phase;
    self(live, slot).rate_hz = static_cast<const SavedBeacon&>(saved).rate_hz;
  }

 private:
  LiveBeacon& self(const model::LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveBeacon&>(placed(live, slot));
  }
};

const bool kRegistered = [] {
  model::register_kind(std::make_unique<BeaconModel>());
  return true;
}();

}  // namespace

}  // namespace ambf::test
