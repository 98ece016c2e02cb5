// The ability to change parameters while the simulation runs, from the next iteration on. A world reset restores the
// loaded values; a reset of bodies does not. Any thread; nothing waits for the physics thread. C++17.
#pragma once

#include "math/types.h"
#include "state/abilities/outcome.h"
#include "state/ids.h"
#include "state/parameters.h"
#include "state/view.h"

namespace ambf::state {

class TuneAbility {
 public:
  virtual ~TuneAbility() = default;
  virtual void set_gravity(const math::Vec3& gravity_world) = 0;
  // Sets a parameter of a body or a joint. `done` receives success, or why it was rejected (state::check, or the object
  // is gone).
  virtual void set_parameter(ObjectId object, Parameter parameter, const math::Vec3& value, Completion done) = 0;
  // Whether position targets of a body (its pose, and joints commanded through it) or of a joint stay in force when
  // their command expires. `done` receives success, or that there is no such body or joint.
  virtual void set_hold(ObjectId object, bool hold, Completion done) = 0;
  // Of a camera, of a light. Values that state::check rejects, and removed objects, are ignored.
  virtual void set_lens(ObjectId camera, const Lens& lens) = 0;
  virtual void set_beam(ObjectId light, const Beam& beam) = 0;
};

}  // namespace ambf::state
