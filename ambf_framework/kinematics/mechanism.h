// Bodies that joints hold together, loops included, and where a body goes when some of the joints are moved: what a
// model that was read or loaded does, without simulating it. Open chains by themselves: chain.h. Not thread-safe; may
// take milliseconds.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "math/types.h"

namespace ambf::kinematics {

struct MechanismJoint {
  enum class Kind { fixed, revolute, prismatic, point };
  std::string name;
  Kind kind = Kind::fixed;
  std::size_t parent = 0, child = 0;      // bodies, by any numbers
  math::Vec3 pivot, axis{0.0, 0.0, 1.0};  // in the parent's frame; the axis has unit length
  math::Pose T_parent_child;              // while the joint is at
  double position = 0.0;                  // rad or m
};

math::Pose at_position(const MechanismJoint& joint, double position);  // T_parent_child

class Mechanism {
 public:
  // `driven`: indices into `joints`, of those that will be moved; the others stay where they are, or go where loops
  // take them. Only joints that lead from parents to children below `base` count.
  Mechanism(const std::vector<MechanismJoint>& joints, std::size_t base, std::size_t tip,
            const std::vector<std::size_t>& driven);

  // Whether joints lead from the base to the tip.
  bool reaches() const { return reaches_; }
  // The first joint on the way there that nothing moves: it is not driven and in no loop. Null: there is none.
  const MechanismJoint* loose() const;

  // T_base_tip with the driven joints at these positions (rad, m; in the order of `driven`). They are moved there
  // in small steps from where they were, so that loops stay in their branch. Nothing: a loop does not close.
  std::optional<math::Pose> move_to(const std::vector<double>& positions);

 private:
  struct Link {
    MechanismJoint joint;
    int driven = -1;       // index into the driven joints
    bool closes = false;   // a loop: its child hangs on another joint
    bool matters = false;  // for the tip
    double now = joint.position;
  };

  std::vector<std::size_t> way_to(std::size_t body) const;  // indices into links_, from the body to the base
  std::vector<std::size_t> loop_of(const Link& closing) const;
  void find_tree(const std::vector<MechanismJoint>& joints, const std::vector<std::size_t>& driven);
  void find_what_matters();
  void pose_bodies();
  std::vector<double> gaps();
  bool close_loops();

  std::vector<Link> links_;           // those of the tree come first, parents before children
  std::vector<int> hangs_on_;         // by body: index into links_, -1: nothing
  std::vector<std::size_t> unknown_;  // indices into links_ of joints that loops move
  std::vector<math::Pose> T_base_;    // by body
  std::size_t base_, tip_;
  bool reaches_ = false, loops_ = false;
};

}  // namespace ambf::kinematics
