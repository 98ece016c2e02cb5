// A fixed joint whose two bodies are chosen while the world runs: what actuators hold with. Its six rows are solved
// together with those of all joints. Made off the physics thread; between World::add() and World::remove() only the
// physics thread may call anything here, and holding and releasing allocate nothing of ours. Never owns its bodies.
//
// While it holds, holder and held body do not collide with each other (as in the original). It ends when either leaves
// the world, and by World::reset().
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "math/types.h"
#include "physics/body.h"
#include "physics/joint.h"

namespace ambf::physics {

namespace detail {
struct GraspData;
}

struct GraspOptions {
  double erp = JointOptions{}.erp;  // share of an error that one step takes back, 0 .. 1
  // Ns along and Nms about each axis, a step; beyond it the held body gives way, and comes back once it can.
  double max_impulse = std::numeric_limits<double>::infinity();
};

struct Hold {
  Body *holder, *held;
  math::Pose T_com_grasp, T_held_grasp;  // as Grasp::hold() has them
};

class Grasp {
 public:
  explicit Grasp(const GraspOptions& options = {});
  ~Grasp();  // leaves its world
  Grasp(const Grasp&) = delete;
  Grasp& operator=(const Grasp&) = delete;

  // From the next step on. `T_com_grasp`: the frame of the grasp in the holder's COM frame. `T_held_grasp`: the frame
  // in the held body's COM frame that is brought there and kept there; absent: the held body is kept where it is. False
  // and no change when it holds already, when either is not in this world, when both are one, or when neither moves.
  bool hold(Body& holder, Body& held, const math::Pose& T_com_grasp,
            const std::optional<math::Pose>& T_held_grasp = std::nullopt);
  void release();  // does nothing while it holds nothing

  // What it holds and where; absent: nothing. For resume().
  std::optional<Hold> current() const;
  // Holds as `was` says after its bodies were put elsewhere: the held body, with all that joints connect to it, goes
  // to where the holder now has it, without a change of any pose among them. False and no change when hold() would
  // refuse, or when joints connect it to a static body or to the holder, so that it cannot follow. Allocates.
  bool resume(const Hold& was);

  bool holds() const { return held() != nullptr; }
  Body* holder() const;  // null: it holds nothing
  Body* held() const;
  // What it did to the held body in the last step, at its COM, world axes; 0 while it holds nothing. The holder feels
  // the opposite force at the same point.
  math::Wrench reaction_on_held() const;
  // How far the held body is from where it should be; 0 while it holds nothing.
  JointGap gap() const;

  detail::GraspData& data() const { return *data_; }

 private:
  std::unique_ptr<detail::GraspData> data_;
};

}  // namespace ambf::physics
