// A made-up kind of objects that the product does not know: a beacon hangs on another object and blinks. Its phase is
// its state, its command sets its rate. What it needs of the simulator is in beacon.cpp.
#pragma once

#include <string>
#include <vector>

#include "model/catalogue.h"
#include "state/kind_rows.h"

namespace ambf::test {

struct BeaconInfo : state::PlacedInfo {
  double rate_hz = 1.0;  // as loaded
};

struct BeaconState : state::PlacedState {
  double phase = 0.0;  // turns since the start
  double rate_hz = 1.0;
};

template <class Visit>
void visit_computed(BeaconState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
  visit(row.phase);
}

struct BeaconCommand {
  double rate_hz = 0.0;
};

// What a file says of one.
struct Beacon {
  std::string name, parent;
  math::Vec3 position;
  double rate_hz = 1.0;
};

const state::PlacedKind<BeaconState>& beacon_kind();

// A model with these beacons, beside what it describes already.
scene::Model with_beacons(scene::Model model, std::vector<Beacon> beacons);

}  // namespace ambf::test
