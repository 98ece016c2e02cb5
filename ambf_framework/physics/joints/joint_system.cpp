#include "physics/joints/joint_system.h"

#include <algorithm>
#include <cmath>

#include "physics/joints/detail/dense_kernels.h"

namespace ambf::physics {
namespace {

constexpr int kUsualRows = 8;
// A pivot below this share of the row's own diagonal entry is rounding, not stiffness.
constexpr double kDeadPivot = 1e-13;
// Work, in visits of a row for each row.
constexpr std::int64_t kVisitsOfFactoring = 8, kVisitsOfSweeping = 4;

// r -= J v for the six Jacobian columns of one side.
template <int kLd>
void subtract_velocity(double* __restrict r, const double* __restrict jacobian, const BodyDelta& v, int run_time_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int d = 0; d < 3; ++d) {
    for (int i = 0; i < ld; ++i) r[i] -= jacobian[d * ld + i] * v.linear[d] + jacobian[(d + 3) * ld + i] * v.angular[d];
  }
}

// v += M^-1 J^T x of one side.
template <int kLd>
void add_response(BodyDelta& v, const double* __restrict response, const double* __restrict x, int run_time_ld) {
  const int ld = kLd > 0 ? kLd : run_time_ld;
  for (int d = 0; d < 3; ++d) {
    double linear = 0.0;
    double angular = 0.0;
    for (int i = 0; i < ld; ++i) {
      linear += response[d * ld + i] * x[i];
      angular += response[(d + 3) * ld + i] * x[i];
    }
    v.linear[d] += linear;
    v.angular[d] += angular;
  }
}

}  // namespace

JointSystem::JointSystem(const BlockStructure& structure, const Options& options)
    : structure_(&structure), options_(options), cholesky_(options.wide) {
  joints_.resize(structure.size());
  for (int p = 0; p < structure.size(); ++p)
    joints_[p].sides = structure.joints()[structure.joint_at(p)].ties_coordinates ? kMaxSides : kSidesOfJoints;
  rows_.assign(structure.size(), kUsualRows);
  cholesky_.lay_out(structure, rows_);  // so that rows coming and going later (limits) find their storage
  const int usual = cholesky_.vector_size();
  for (auto* values : {&target_, &given_back_, &softness_, &own_softness_, &diagonal_, &threshold_, &impulse_,
                       &follow_impulse_, &change_, &residual_}) {
    values->reserve(usual);
  }
  bounds_.reserve(usual);
  state_.reserve(usual);
  previous_state_.reserve(usual);
  pinned_.reserve(usual);
  shifts_.reserve(usual);
  bounded_.reserve(usual);
  offenders_.reserve(usual);
  const std::size_t columns = lay_out_columns();
  jacobian_.reserve(columns);
  response_.reserve(columns);
  rows_.assign(structure.size(), 0);
  previous_rows_.assign(structure.size(), 0);
  cholesky_.lay_out(structure, rows_);
  bounded_begin_.assign(structure.components().size() + 1, 0);
  factored_.assign(structure.components().size(), 0);
  taken_back_.assign(structure.components().size(), 0);
}

void JointSystem::begin(const std::vector<int>& rows_of_joint, bool again) {
  if (!again) work_left_ = options_.work_limit;
  bool same = true;
  for (int j = 0; j < structure_->size(); ++j) {
    const int p = structure_->position_of(j);
    previous_rows_[p] = rows_[p];
    if (rows_[p] != rows_of_joint[j]) same = false;
    rows_[p] = rows_of_joint[j];
  }
  if (same) return;
  previous_state_ = state_;
  cholesky_.lay_out(*structure_, rows_);
  const int n = cholesky_.vector_size();
  for (auto* values : {&target_, &given_back_, &softness_, &own_softness_, &diagonal_, &threshold_, &impulse_,
                       &follow_impulse_, &change_, &residual_}) {
    values->assign(n, 0.0);
  }
  bounds_.assign(n, RowBounds{});
  state_.assign(n, RowState::free);
  pinned_.assign(n, 0);
  shifts_.assign(n, 1);
  const std::size_t columns = lay_out_columns();
  jacobian_.assign(columns, 0.0);
  response_.assign(columns, 0.0);
  int old_begin = 0;
  for (int p = 0; p < structure_->size(); ++p) {
    if (rows_[p] == previous_rows_[p]) {
      std::copy_n(previous_state_.begin() + old_begin, rows_[p], state_.begin() + cholesky_.row_begin(p));
    }
    old_begin += dense::padded(previous_rows_[p]);
  }
}

std::size_t JointSystem::lay_out_columns() {
  std::size_t columns = 0;
  for (int p = 0; p < structure_->size(); ++p) {
    joints_[p].begin = columns;
    columns += static_cast<std::size_t>(6 * joints_[p].sides * cholesky_.leading_dimension(p));
  }
  return columns;
}

void JointSystem::set_bodies(int joint, const std::array<int, kMaxSides>& bodies) {
  joints_[structure_->position_of(joint)].bodies = bodies;
}

JointSystem::Place JointSystem::place_of(int joint) {
  const int p = structure_->position_of(joint);
  const bool loops = structure_->components()[structure_->component_of(p)].closes_loops;
  return {cholesky_.row_begin(p), cholesky_.leading_dimension(p), jacobian_.data() + joints_[p].begin,
          response_.data() + joints_[p].begin, loops ? options_.loop_regularisation : options_.regularisation};
}

void JointSystem::set_row(int joint, int row, const JointRow& values) {
  const Place place = place_of(joint);
  double diagonal = 0.0;
  for (int d = 0; d < 6 * joints_[structure_->position_of(joint)].sides; ++d) {
    place.jacobian[d * place.ld + row] = values.jacobian[d];
    place.response[d * place.ld + row] = values.response[d];
    diagonal += values.jacobian[d] * values.response[d];
  }
  finish_row(place, row, diagonal, values.target, values.softness, values.bounds, true);
}

template <bool kWide>
AMBF_INLINED void JointSystem::multiply_jacobians(int p) {
  const BlockStructure& s = *structure_;
  const int columns = rows_[p], column_ld = cholesky_.leading_dimension(p);
  if (columns == 0) return;
  const std::uint8_t* const shifts = shifts_.data() + cholesky_.row_begin(p);
  for (int k = s.couplings_begin(p); k < s.couplings_begin(p + 1); ++k) {
    const auto& coupling = s.couplings()[k];
    const int ld = cholesky_.leading_dimension(coupling.row);
    if (ld == 0) continue;
    const double* left = jacobian_.data() + joints_[coupling.row].begin + coupling.side_row * 6 * ld;
    const double* right = response_.data() + joints_[p].begin + coupling.side_column * 6 * column_ld;
    double* const to = cholesky_.a(coupling.block);
    dense::with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
      const auto multiply = [&]<bool kLower, bool kFresh>() AMBF_INLINED_LAMBDA {
        dense::multiply_jacobian<kWide, kLd, kLower, kFresh>(to, left, right, shifts, ld, columns, column_ld);
      };
      if (coupling.block == p) {
        coupling.first ? multiply.template operator()<true, true>() : multiply.template operator()<true, false>();
      } else {
        coupling.first ? multiply.template operator()<false, true>() : multiply.template operator()<false, false>();
      }
    });
  }
}

AMBF_WIDE void JointSystem::multiply_jacobians_wide(int p) { multiply_jacobians<true>(p); }

void JointSystem::assemble() {
  const BlockStructure& s = *structure_;
  bounded_.clear();
  for (int c = 0; c < static_cast<int>(s.components().size()); ++c) {
    const auto& component = s.components()[c];
    bounded_begin_[c] = static_cast<int>(bounded_.size());
    for (int p = component.first; p < component.last; ++p) {
      for (int i = 0; i < rows_[p]; ++i) {
        const int k = cholesky_.row_begin(p) + i;
        threshold_[k] = kDeadPivot * diagonal_[k];
        impulse_[k] = 0.0;
        pinned_[k] = state_[k] != RowState::free;
        if (is_bounded(bounds_[k])) bounded_.push_back({k, p});
      }
      if (options_.wide) {
        multiply_jacobians_wide(p);
      } else {
        multiply_jacobians<false>(p);
      }
      double* diagonal_block = cholesky_.a(p);
      for (int i = 0; i < rows_[p]; ++i) {
        diagonal_block[i * cholesky_.leading_dimension(p) + i] += softness_[cholesky_.row_begin(p) + i];
      }
    }
    factored_[c] = taken_back_[c] = 0;
    cholesky_.mark_all_changed(component);
  }
  bounded_begin_.back() = static_cast<int>(bounded_.size());
}

void JointSystem::residual_of(int p, const BodyDelta* bodies, double* out) const {
  const int ld = cholesky_.leading_dimension(p);
  const int begin = cholesky_.row_begin(p);
  for (int i = 0; i < ld; ++i) out[i] = target_[begin + i] - softness_[begin + i] * impulse_[begin + i];
  subtract_velocities(p, bodies, out);
}

void JointSystem::subtract_velocities(int p, const BodyDelta* bodies, double* out) const {
  const int ld = cholesky_.leading_dimension(p);
  const Joint& joint = joints_[p];
  const double* jacobian = jacobian_.data() + joint.begin;
  dense::with_fixed_ld(ld, [&]<int kLd>() {
    for (int s = 0; s < joint.sides; ++s)
      if (joint.bodies[s] >= 0) subtract_velocity<kLd>(out, jacobian + 6 * s * ld, bodies[joint.bodies[s]], ld);
  });
}

void JointSystem::apply(int p, const double* change, BodyDelta* bodies) const {
  const int ld = cholesky_.leading_dimension(p);
  const Joint& joint = joints_[p];
  const double* response = response_.data() + joint.begin;
  dense::with_fixed_ld(ld, [&]<int kLd>() {
    for (int s = 0; s < joint.sides; ++s)
      if (joint.bodies[s] >= 0) add_response<kLd>(bodies[joint.bodies[s]], response + 6 * s * ld, change, ld);
  });
}

// impulses += change_, and the bodies feel it.
void JointSystem::apply_all(const BlockStructure::Component& component, BodyDelta* bodies) {
  for (int p = component.first; p < component.last; ++p) {
    if (rows_[p] == 0) continue;
    const int begin = cholesky_.row_begin(p);
    for (int i = 0; i < rows_[p]; ++i) impulse_[begin + i] += change_[begin + i];
    apply(p, change_.data() + begin, bodies);
  }
}

// Pinned rows get exactly their bound.
void JointSystem::move_to_bounds(const BlockStructure::Component& component, BodyDelta* bodies) {
  const int c = structure_->component_of(component.first);
  for (int b = bounded_begin_[c]; b < bounded_begin_[c + 1]; ++b) {
    const auto [k, p] = bounded_[b];
    if (!pinned_[k]) continue;
    const double bound = bound_value(state_[k], bounds_[k]);
    if (impulse_[k] == bound) continue;
    const int begin = cholesky_.row_begin(p);
    std::fill_n(change_.begin() + begin, cholesky_.leading_dimension(p), 0.0);
    change_[k] = bound - impulse_[k];
    apply(p, change_.data() + begin, bodies);
    impulse_[k] = bound;
  }
}

void JointSystem::factor(const BlockStructure::Component& component, JointSolveCounts& counts) {
  const int c = structure_->component_of(component.first);
  if (factored_[c]) return;
  counts.dead_rows += static_cast<std::uint64_t>(cholesky_.factor(component, pinned_.data(), threshold_.data()));
  ++counts.factorisations;
  factored_[c] = 1;
}

void JointSystem::solve_free(const BlockStructure::Component& component, BodyDelta* bodies, JointSolveCounts& counts) {
  const int c = structure_->component_of(component.first);
  factor(component, counts);
  for (int p = component.first; p < component.last; ++p) {
    if (rows_[p] > 0) residual_of(p, bodies, change_.data() + cholesky_.row_begin(p));
  }
  for (int b = bounded_begin_[c]; b < bounded_begin_[c + 1]; ++b) {
    if (pinned_[bounded_[b].row]) change_[bounded_[b].row] = 0.0;
  }
  cholesky_.solve(component, change_.data());
  ++counts.solves;
  apply_all(component, bodies);
}

int JointSystem::find_offenders(const BlockStructure::Component& component, const BodyDelta* bodies) {
  const int c = structure_->component_of(component.first);
  double largest_impulse = 0.0;
  double largest_target = 0.0;
  for (int k = cholesky_.row_begin(component.first); k < cholesky_.row_begin(component.last); ++k) {
    largest_impulse = std::max(largest_impulse, std::fabs(impulse_[k]));
    largest_target = std::max(largest_target, std::fabs(target_[k]));
  }
  const double tolerance_x = 1e-12 * largest_impulse;
  const double tolerance_w = 1e-10 * largest_target + 1e-13;
  offenders_.clear();
  int fresh_position = -1;  // the joint whose residual_ is up to date
  for (int b = bounded_begin_[c]; b < bounded_begin_[c + 1]; ++b) {
    const auto [k, p] = bounded_[b];
    double w = 0.0;
    if (pinned_[k] && !is_held(bounds_[k])) {
      if (fresh_position != p) residual_of(p, bodies, residual_.data() + cholesky_.row_begin(p));
      fresh_position = p;
      w = -residual_[k];
    }
    if (offends(state_[k], impulse_[k], w, bounds_[k], tolerance_x, tolerance_w)) offenders_.push_back(b);
  }
  return static_cast<int>(offenders_.size());
}

void JointSystem::exchange(int row, int position) {
  state_[row] = exchanged(state_[row], impulse_[row], bounds_[row]);
  pinned_[row] = state_[row] != RowState::free;
  cholesky_.mark_changed(position);
}

bool JointSystem::solve_rows(int c, BodyDelta* bodies, JointSolveCounts& counts) {
  const auto& component = structure_->components()[c];
  if (cholesky_.row_begin(component.first) == cholesky_.row_begin(component.last)) return true;
  const bool bounded = bounded_begin_[c] != bounded_begin_[c + 1];
  const int rows = cholesky_.row_begin(component.last) - cholesky_.row_begin(component.first);
  work_left_ -= rows;
  PivotRule rule;
  for (int round = 0; round <= options_.round_limit; ++round) {
    if (bounded) move_to_bounds(component, bodies);
    solve_free(component, bodies, counts);
    if (!bounded) return true;
    const PivotRule::Exchange next = rule.next(find_offenders(component, bodies));
    if (next == PivotRule::Exchange::none) return true;
    if (exhausted()) break;
    work_left_ -= kVisitsOfFactoring * rows;
    ++counts.active_set_rounds;
    const std::size_t from = next == PivotRule::Exchange::all ? 0 : offenders_.size() - 1;
    for (std::size_t i = from; i < offenders_.size(); ++i) {
      exchange(bounded_[offenders_[i]].row, bounded_[offenders_[i]].position);
    }
    factored_[c] = 0;
  }
  ++counts.fallbacks;
  work_left_ -= kVisitsOfSweeping * options_.fallback_sweeps * rows;
  sweep(component, bodies);
  return false;
}

double JointSystem::residual(int c, const BodyDelta* bodies) {
  const auto& component = structure_->components()[c];
  double largest = 0.0;
  for (int p = component.first; p < component.last; ++p) {
    const int begin = cholesky_.row_begin(p);
    if (rows_[p] > 0) residual_of(p, bodies, residual_.data() + begin);
    for (int i = 0; i < rows_[p]; ++i) {
      if (!pinned_[begin + i]) largest = std::max(largest, std::fabs(residual_[begin + i]));
    }
  }
  return largest;
}

}  // namespace ambf::physics
