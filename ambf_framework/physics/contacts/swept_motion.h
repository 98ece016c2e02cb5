// Fast bodies do not pass through what they would pass within one step: a body that moves by more than half its size in
// a step is swept along its way, and stops in that step where it would meet something; the next step finds the contact
// and its impact. What is swept are the largest balls around the centres of its convex parts (meshes are not swept), of
// bodies without joints. Others move as their velocity says during the step. Scenes without fast bodies pay one
// comparison a body. Physics thread.
#pragma once

#include <vector>

#include "physics/detail/body_data.h"

namespace ambf::physics::detail {

// The balls of a shape, in its frame; none for meshes, planes and parts that do not contain their own centre.
std::vector<SweptBall> swept_balls(const btCollisionShape& shape);

class SweptMotion {
 public:
  // Before bodies are moved by a step of h seconds: how far each of the fast ones gets.
  void begin_step(btCollisionWorld& world, const btAlignedObjectArray<btRigidBody*>& bodies, double h);
  // How much of its way in this step the body may go: 1, or less where it meets something. In the order of `bodies`.
  double share_of(int body);

 private:
  struct Stopped {
    int body;
    double share;  // of its way
  };
  std::vector<Stopped> stopped_;  // ascending
  std::size_t next_ = 0;
};

}  // namespace ambf::physics::detail
