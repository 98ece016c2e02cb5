// Pushes the bodies of an island with joints out of each other, beside their velocities: moves (pseudo-velocities)
// that the joints follow, found by sweeps over the normals of the contacts. What joints do not allow stays inside:
// nothing of it reaches velocities, impulses or reported forces. docs/solver.md says why. It knows no Bullet; storage
// only grows. Physics thread.
#pragma once

#include <cstdint>
#include <vector>

#include "physics/contacts/contact_system.h"
#include "physics/joints/joint_system.h"

namespace ambf::physics {

class DepthPush {
 public:
  // NormalRow::push_impulse is what the last step found (0: a new contact) and becomes what this one finds;
  // NormalRow::impulse loses a little where the push is in vain. `touched`: the components of `joints` that contacts
  // act on. False: nothing is deep enough for a push of `slowest` (m/s), there are no moves.
  bool solve(ContactSystem& contacts, const std::vector<BodyDelta>& bodies, JointSystem& joints,
             const std::vector<std::uint8_t>& touched, double slowest, JointSolveCounts& counts);

  // By body: m/s and rad/s that move it in this step and are gone after it.
  const std::vector<BodyDelta>& moves() const { return moves_; }

 private:
  // Moves that joints follow, from the push impulses that there are, until no contact is wrong by more than `enough`.
  void find_moves(ContactSystem& contacts, const std::vector<BodyDelta>& bodies, JointSystem& joints,
                  const std::vector<std::uint8_t>& touched, double enough, JointSolveCounts& counts);
  void bound(ContactSystem& contacts);

  std::vector<BodyDelta> moves_;
};

}  // namespace ambf::physics
