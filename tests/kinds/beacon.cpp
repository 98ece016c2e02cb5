// Beacons in structures and frames.
#include "beacon.h"

namespace ambf::test {

const state::PlacedKind<BeaconState>& beacon_kind() {
  static const auto registered = state::register_placed_kind<BeaconInfo, BeaconState>({"beacon", "beacon", "beacons"});
  return registered;
}

}  // namespace ambf::test
