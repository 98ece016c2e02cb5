// What a constraint of Bullet is to the joint solver. Private to physics/joints. Physics thread.
#pragma once

#include "physics/joints/detail/block_structure.h"
#include "physics/joints/joint_data.h"
#include "physics/joints/mimic_constraint.h"

namespace ambf::physics {

// Null: another constraint.
const detail::MimicConstraint* mimic_of(const btTypedConstraint& constraint);

// Null: another constraint.
detail::JointData* joint_of(btTypedConstraint& constraint);

// Null: it has none in this step, or is another constraint.
const detail::FarLimits* far_limits_of(const btTypedConstraint& constraint);

// `rows`: how many it has in this step.
JointEnds ends_of(const btTypedConstraint& constraint, int rows);

}  // namespace ambf::physics
