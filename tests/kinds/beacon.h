// A made-up kind of objects that the product does not know: a beacon hangs on another object and blinks. Its phase is
// its state, its command sets its rate. It is whole in this folder, one file a layer: beacon.h/.cpp (state),
// beacon_block.cpp (ADF), beacon_model.cpp, beacon_endpoint.cpp (ROS), beacon_view.cpp (window and panel), beacon.py
// (client). Each file registers its part before main(). C++17.
#pragma once

#include <string>

#include "math/types.h"
#include "state/kind_rows.h"

namespace ambf::scene {
struct BlockKind;
}

namespace ambf::test {

struct BeaconInfo : state::PlacedInfo {
  double rate_hz = 1.0;  // as loaded
};

struct BeaconState : state::PlacedState {
  double phase = 0.0;  // blinks since the start
  double rate_hz = 1.0;
};

template <class Visit>
void visit_computed(BeaconState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
  visit(row.phase);
}

inline constexpr double kMaxBeaconRate_hz = 1000.0;

struct BeaconCommand {
  double rate_hz = 0.0;
};

// An ADF block.
struct Beacon {
  std::string parent;  // empty: the world
  math::Vec3 position;
  double rate_hz = 1.0;
};

const state::PlacedKind<BeaconState>& beacon_kind();
const scene::BlockKind& beacon_blocks();

}  // namespace ambf::test
