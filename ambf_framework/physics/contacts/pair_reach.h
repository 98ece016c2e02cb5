// What stands still has boxes that say little: a plane's is infinite, that of a room's walls holds all that is in the
// room. Whether something else's box comes near one of its parts is cheap to know, and spares algorithms, manifolds and
// children of compounds for all that is in the middle of the room. Contacts are the same: boxes
// reach as far as contacts are kept. Physics thread; allocates nothing.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

namespace ambf::physics::detail {

// `low`, `high`: corners of the other body's box, world axes (m). True for what does not stand still, or is neither a
// plane nor a compound of a few parts.
bool comes_near(btCollisionObject& still, const btVector3& low, const btVector3& high);

}  // namespace ambf::physics::detail
