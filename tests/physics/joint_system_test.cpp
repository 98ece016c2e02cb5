// Properties of the factorisation and of the active set, on random mechanisms against dense arithmetic.
#include "physics/joints/joint_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/physics/random_mechanism.h"

namespace ambf::physics::testing {
namespace {

using Shape = RandomMechanism::Shape;

struct Solved {
  std::vector<double> x;  // impulses, in the order of joints
  std::vector<RowState> states;
  std::vector<BodyDelta> bodies;
  JointSolveCounts counts;
  bool exact = true;
};

Solved solve_all(JointSystem& system, const RandomMechanism& problem) {
  Solved result;
  result.bodies.resize(problem.body_count);
  for (int c = 0; c < static_cast<int>(system.structure().components().size()); ++c) {
    result.exact = system.solve(c, result.bodies.data(), result.counts) && result.exact;
  }
  for (std::size_t joint = 0; joint < problem.joints.size(); ++joint) {
    for (int r = 0; r < problem.rows[joint]; ++r) {
      result.x.push_back(system.impulse(static_cast<int>(joint), r));
      result.states.push_back(system.state(static_cast<int>(joint), r));
    }
  }
  return result;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double v : values) result = std::max(result, std::fabs(v));
  return result;
}

// Eq. 2.17, row by row; `scale` is the size of the numbers that w was made of.
// The same regularisation with and without loops, as the dense reference has it.
JointSystem::Options uniform(double regularisation = 1e-6) {
  JointSystem::Options options;
  options.regularisation = options.loop_regularisation = regularisation;
  options.max_given = std::numeric_limits<double>::infinity();  // one solution, no more
  return options;
}

void expect_conditions(const RandomMechanism& problem, const std::vector<double>& x, double regularisation,
                       double scale) {
  const std::vector<double> ax = problem.dense(regularisation).times(x);
  const std::vector<double> b = problem.targets();
  const std::vector<RowBounds> bounds = problem.bounds();
  const double tolerance_x = 1e-9 * largest(x);
  const double tolerance_w = 1e-8 * scale;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double w = ax[i] - b[i];
    EXPECT_GE(x[i], bounds[i].lower - tolerance_x);
    EXPECT_LE(x[i], bounds[i].upper + tolerance_x);
    if (is_held(bounds[i])) continue;
    if (x[i] > bounds[i].lower + tolerance_x) {
      EXPECT_LE(w, tolerance_w);
    }
    if (x[i] < bounds[i].upper - tolerance_x) {
      EXPECT_GE(w, -tolerance_w);
    }
  }
}

TEST(BlockStructure, EliminatesATreeWithoutFill) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const auto problem = RandomMechanism::make(random, Shape::tree, false, false);
    const BlockStructure structure(problem.joints);
    int pairs = 0;
    for (std::size_t i = 0; i < problem.joints.size(); ++i) {
      for (std::size_t j = i + 1; j < problem.joints.size(); ++j) {
        const auto& a = problem.joints[i];
        const auto& b = problem.joints[j];
        const auto meets = [&](int body) { return body >= 0 && (body == b.body_a || body == b.body_b); };
        if (meets(a.body_a) || meets(a.body_b)) ++pairs;
      }
    }
    EXPECT_EQ(structure.block_count(), structure.size() + pairs);
  }
}

TEST(BlockStructure, GivesEachMechanismItsOwnComponent) {
  // Two chains of two joints and a single one; body 7 belongs to no joint.
  const BlockStructure structure({{-1, 3}, {-1, 5}, {5, 6}, {3, 4}, {-1, 8}});
  ASSERT_EQ(structure.components().size(), 3U);
  const auto component = [&](int joint) { return structure.component_of(structure.position_of(joint)); };
  EXPECT_EQ(component(0), component(3));
  EXPECT_EQ(component(1), component(2));
  EXPECT_NE(component(0), component(1));
  EXPECT_NE(component(0), component(4));
}

TEST(BlockCholesky, AgreesWithDenseEliminationOnRandomMechanisms) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const Shape shape = static_cast<Shape>(trial % 3);
    const auto problem = RandomMechanism::make(random, shape, false, false);
    const BlockStructure structure(problem.joints);
    const JointSystem::Options options = uniform(1e-6);
    JointSystem system(structure, options);
    problem.load(system);
    const Solved solved = solve_all(system, problem);
    const std::vector<double> reference = problem.dense(options.regularisation).solve(problem.targets());
    ASSERT_EQ(reference.size(), solved.x.size());
    const double scale = largest(reference);
    for (std::size_t i = 0; i < reference.size(); ++i) EXPECT_NEAR(solved.x[i], reference[i], 1e-7 * scale) << trial;
    EXPECT_EQ(solved.counts.dead_rows, 0U);
  }
}

TEST(JointSystem, GivesTheSameBitsWithWideVectorsAndWithout) {
  if (!has_wide_vectors()) GTEST_SKIP() << "this processor has no AVX2";
  std::mt19937 random(12);
  for (int trial = 0; trial < 60; ++trial) {
    const auto problem = RandomMechanism::make(random, static_cast<Shape>(trial % 3), true, trial % 2 == 0);
    const BlockStructure structure(problem.joints);
    JointSystem::Options options;
    const auto solved = [&](bool wide) {
      options.wide = wide;
      JointSystem system(structure, options);
      problem.load(system);
      return solve_all(system, problem).x;
    };
    EXPECT_EQ(solved(true), solved(false)) << trial;
  }
}

TEST(BlockCholesky, SolvesRedundantRowsThatAgreeWithEachOther) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const auto problem = RandomMechanism::make(random, static_cast<Shape>(trial % 3), false, true);
    const BlockStructure structure(problem.joints);
    JointSystem system(structure, uniform());
    problem.load(system);
    const Solved solved = solve_all(system, problem);
    // The repeated rows ask for the same, so every row can be met: w = 0 up to the regularisation.
    const std::vector<double> ax = problem.dense(0.0).times(solved.x);
    const std::vector<double> b = problem.targets();
    const DenseMatrix a = problem.dense(0.0);
    for (std::size_t i = 0; i < ax.size(); ++i) {
      const int k = static_cast<int>(i);
      EXPECT_NEAR(ax[i], b[i], 2.0 * uniform().regularisation * a(k, k) * std::fabs(solved.x[i]) + 1e-7) << trial;
    }
  }
}

TEST(JointSystem, LeavesBodiesWithTheVelocitiesOfItsImpulses) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const auto problem = RandomMechanism::make(random, static_cast<Shape>(trial % 3), true, false);
    const BlockStructure structure(problem.joints);
    JointSystem system(structure, uniform());
    problem.load(system);
    const Solved solved = solve_all(system, problem);
    std::vector<BodyDelta> expected(problem.body_count);
    std::size_t i = 0;
    for (std::size_t joint = 0; joint < problem.joints.size(); ++joint) {
      for (const JointRow& row : problem.row_data[joint]) {
        for (const int side : {0, 1}) {
          const int body = side == 0 ? problem.joints[joint].body_a : problem.joints[joint].body_b;
          if (body < 0) continue;
          for (int d = 0; d < 3; ++d) {
            expected[body].linear[d] += row.response[6 * side + d] * solved.x[i];
            expected[body].angular[d] += row.response[6 * side + 3 + d] * solved.x[i];
          }
        }
        ++i;
      }
    }
    for (int body = 0; body < problem.body_count; ++body) {
      for (int d = 0; d < 3; ++d) {
        EXPECT_NEAR(solved.bodies[body].linear[d], expected[body].linear[d], 1e-7);
        EXPECT_NEAR(solved.bodies[body].angular[d], expected[body].angular[d], 1e-7);
      }
    }
  }
}

TEST(ActiveSet, MeetsTheConditionsOfBoundedRowsOnRandomMechanisms) {
  std::mt19937 random(5);
  std::uint64_t exchanges = 0;
  int bounded_problems = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto problem = RandomMechanism::make(random, static_cast<Shape>(trial % 3), true, trial % 5 == 0);
    const BlockStructure structure(problem.joints);
    JointSystem system(structure, uniform());
    problem.load(system);
    const Solved solved = solve_all(system, problem);
    EXPECT_TRUE(solved.exact) << trial;
    expect_conditions(problem, solved.x, uniform().regularisation, 1.0);
    exchanges += solved.counts.active_set_rounds;
    const auto bounds = problem.bounds();
    bounded_problems += std::any_of(bounds.begin(), bounds.end(), is_bounded) ? 1 : 0;
  }
  EXPECT_GT(bounded_problems, 500);
  EXPECT_GT(exchanges, 500U);
}

TEST(ActiveSet, FindsTheSameSolutionFromAnyRememberedState) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 200; ++trial) {
    const auto problem = RandomMechanism::make(random, Shape::loops, true, false);
    const BlockStructure structure(problem.joints);
    JointSystem fresh(structure, {});
    problem.load(fresh);
    const Solved first = solve_all(fresh, problem);
    // Solve something else in between, of which the states are remembered.
    auto other = problem;
    for (auto& rows : other.row_data) {
      for (auto& row : rows) row.target = -row.target;
    }
    JointSystem used(structure, {});
    other.load(used);
    solve_all(used, other);
    problem.load(used);
    const Solved second = solve_all(used, problem);
    const double scale = largest(first.x);
    for (std::size_t i = 0; i < first.x.size(); ++i) EXPECT_NEAR(first.x[i], second.x[i], 1e-8 * scale + 1e-12);
    EXPECT_EQ(first.states, second.states);
  }
}

TEST(ActiveSet, RemembersStatesSoThatTheSameProblemNeedsOneFactorisationAComponent) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const auto problem = RandomMechanism::make(random, Shape::loops, true, false);
    const BlockStructure structure(problem.joints);
    JointSystem system(structure, uniform());
    problem.load(system);
    solve_all(system, problem);
    problem.load(system);
    const Solved again = solve_all(system, problem);
    EXPECT_EQ(again.counts.active_set_rounds, 0U);
    EXPECT_LE(again.counts.factorisations, structure.components().size());
  }
}

TEST(ActiveSet, RefactoringInPartGivesTheBitsOfAWholeFactorisation) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 100; ++trial) {
    const auto problem = RandomMechanism::make(random, Shape::loops, false, false);
    const BlockStructure structure(problem.joints);
    std::vector<int> rows(structure.size());
    for (int j = 0; j < structure.size(); ++j) rows[structure.position_of(j)] = problem.rows[j];
    BlockCholesky partly(has_wide_vectors());
    partly.lay_out(structure, rows);
    // Any matrix of the pattern that dominates its diagonal is positive definite.
    for (int id = 0; id < structure.block_count(); ++id) {
      const auto& block = structure.block(id);
      for (int c = 0; c < rows[block.column]; ++c) {
        for (int r = 0; r < rows[block.row]; ++r) {
          const double value = std::uniform_real_distribution<>(-1.0, 1.0)(random);
          const bool diagonal = block.row == block.column && r == c;
          partly.a(id)[c * partly.leading_dimension(block.row) + r] = diagonal ? 200.0 : value;
        }
      }
    }
    BlockCholesky wholly = partly;
    const std::size_t size = static_cast<std::size_t>(partly.vector_size());
    if (size == 0) continue;
    std::vector<std::uint8_t> pinned(size, 0);
    const std::vector<double> threshold(size, 1e-12);
    for (const auto& component : structure.components()) partly.factor(component, pinned.data(), threshold.data());
    const int changed = static_cast<int>(random() % static_cast<unsigned>(structure.size()));
    if (rows[changed] == 0) continue;
    pinned[static_cast<std::size_t>(partly.row_begin(changed))] = 1;
    partly.mark_changed(changed);
    std::vector<double> x(size, 0.0);
    for (int p = 0; p < structure.size(); ++p) {
      for (int r = 0; r < rows[p]; ++r) {
        const int k = partly.row_begin(p) + r;
        x[k] = pinned[k] ? 0.0 : 1.0 + k;
      }
    }
    std::vector<double> y = x;
    for (const auto& component : structure.components()) {
      partly.factor(component, pinned.data(), threshold.data());
      partly.solve(component, x.data());
      wholly.factor(component, pinned.data(), threshold.data());
      wholly.solve(component, y.data());
    }
    EXPECT_EQ(x, y) << trial;
  }
}

TEST(ActiveSet, FallsBackToBoundedImpulsesAndClosedJointsWhenItsRoundsOrItsWorkRunOut) {
  std::mt19937 random(9);
  int fallbacks = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto problem = RandomMechanism::make(random, Shape::tree, true, false);
    const BlockStructure structure(problem.joints);
    JointSystem::Options options = uniform();
    if (trial % 2 == 0)
      options.round_limit = 0;
    else
      options.work_limit = 0;
    JointSystem system(structure, options);
    problem.load(system);
    const Solved solved = solve_all(system, problem);
    EXPECT_EQ(solved.counts.active_set_rounds, trial % 2 == 0 && !solved.exact ? solved.counts.fallbacks : 0U);
    EXPECT_EQ(system.exhausted(), trial % 2 == 1);
    if (solved.exact) continue;
    ++fallbacks;
    const auto bounds = problem.bounds();
    const auto w = problem.dense(options.regularisation).times(solved.x);
    const auto b = problem.targets();
    for (std::size_t i = 0; i < solved.x.size(); ++i) {
      EXPECT_GE(solved.x[i], bounds[i].lower);
      EXPECT_LE(solved.x[i], bounds[i].upper);
      if (!is_bounded(bounds[i])) {
        EXPECT_NEAR(w[i], b[i], 1e-7);
      }
    }
  }
  EXPECT_GT(fallbacks, 40);
}

TEST(JointSystem, EndsAndKeepsOtherMechanismsCleanWhenOneIsNotANumber) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 100; ++trial) {
    auto problem = RandomMechanism::make(random, Shape::separate, true, false);
    if (problem.body_count < 8 || problem.rows[0] == 0 || problem.rows[4] == 0) continue;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    JointRow& row = problem.row_data[0][0];
    switch (trial % 3) {
      case 0: row.target = nan; break;
      case 1: row.jacobian[7] = nan; break;
      default: row.response[8] = std::numeric_limits<double>::infinity(); break;
    }
    row.bounds = trial % 2 == 0 ? RowBounds{} : RowBounds{-0.01, 0.01};
    const BlockStructure structure(problem.joints);
    JointSystem system(structure, uniform());
    problem.load(system);
    const Solved solved = solve_all(system, problem);
    for (int body = 4; body < 8; ++body) {
      for (int d = 0; d < 3; ++d) EXPECT_TRUE(std::isfinite(solved.bodies[body].linear[d]));
    }
  }
}

TEST(JointSystem, GivesARowThatMovesNothingNoImpulse) {
  // Two rows between bodies of which one cannot turn about an axis; the second row asks just for that turn.
  const BlockStructure structure({{-1, 0}});
  JointSystem system(structure, uniform());
  system.begin({2});
  system.set_bodies(0, {-1, 0, -1, -1});
  JointRow row{};
  row.jacobian[6] = row.response[6] = 1.0;
  row.target = 1.0;
  system.set_row(0, 0, row);
  JointRow dead{};
  dead.jacobian[9] = 1.0;
  dead.target = 1.0;
  system.set_row(0, 1, dead);
  system.assemble();
  BodyDelta body;
  JointSolveCounts counts;
  EXPECT_TRUE(system.solve(0, &body, counts));
  EXPECT_NEAR(system.impulse(0, 0), 1.0, 1e-6);
  EXPECT_EQ(system.impulse(0, 1), 0.0);
  EXPECT_NEAR(body.linear[0], 1.0, 1e-6);
}

}  // namespace
}  // namespace ambf::physics::testing
