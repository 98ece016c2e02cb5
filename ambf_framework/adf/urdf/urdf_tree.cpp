#include "adf/detail/urdf_tree.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"

namespace ambf::adf::urdf {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix matrix_of(const std::array<double, 6>& t) {
  return {{{t[0], t[1], t[2]}, {t[1], t[3], t[4]}, {t[2], t[4], t[5]}}};
}

Matrix matrix_of(const math::Quat& q) {
  double m[9];
  math::to_matrix(q, m);
  return {{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}};
}

// R T R^T
Matrix turned(const Matrix& r, const Matrix& t) {
  Matrix out{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) out[i][j] += r[i][k] * t[k][l] * r[j][l];
  return out;
}

// About a point instead of the centre of mass, which lies at `from` as seen from the point (parallel axes).
Matrix moved(Matrix tensor, double mass, const math::Vec3& from) {
  const double d[3] = {from.x, from.y, from.z};
  const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) tensor[i][j] += mass * ((i == j ? square : 0.0) - d[i] * d[j]);
  return tensor;
}

// Mass, centre and tensor of two links that are one body; `child`'s are placed in the parent by T_parent_child.
void add_inertia(Link& parent, const Link& child, const math::Pose& T_parent_child) {
  const double child_mass = child.has_inertial ? child.mass : 0.0;
  if (child_mass <= 0.0) return;
  const math::Pose child_com = T_parent_child * child.inertial;
  const double parent_mass = parent.has_inertial ? parent.mass : 0.0, mass = parent_mass + child_mass;
  const math::Vec3 com = parent.inertial.position * (parent_mass / mass) + child_com.position * (child_mass / mass);
  const Matrix a = moved(turned(matrix_of(parent.inertial.orientation), matrix_of(parent.inertia)), parent_mass,
                         parent.inertial.position - com);
  const Matrix b =
      moved(turned(matrix_of(child_com.orientation), matrix_of(child.inertia)), child_mass, child_com.position - com);
  const auto sum = [&](int i, int j) { return (parent_mass > 0.0 ? a[i][j] : 0.0) + b[i][j]; };
  parent.inertia = {sum(0, 0), sum(0, 1), sum(0, 2), sum(1, 1), sum(1, 2), sum(2, 2)};
  parent.inertial = {com, {}};
  parent.mass = mass;
  parent.has_inertial = true;
}

// Time and memory are linear in links, joints and shapes: robots are strangers' files.
class Planner {
 public:
  Planner(Robot robot, const Treatment& treatment, const Warn& warn)
      : robot_(std::move(robot)), treatment_(treatment), warn_(warn), folds_(robot_.links.size()) {
    for (std::size_t i = 0; i < robot_.links.size(); ++i) number_[robot_.links[i].name] = i;
    for (const Joint& joint : robot_.joints) ends_.push_back({number_.at(joint.parent), number_.at(joint.child)});
    root_ = number_.at(robot_.root);
  }

  Plan plan() {
    list_joints_below();
    skip_empty_root();
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) fold(i);
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) hang_on_whole(i);
    list_joints_below();
    place();
    return std::move(plan_);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Ends {
    std::size_t parent, child;  // links; parent kNone: the joint is gone
  };
  // A link that became part of another one.
  struct Fold {
    std::size_t into = kNone;
    math::Pose T_into_link;
    std::vector<std::pair<std::size_t, math::Pose>> parts;  // links folded into this one, in their order
  };

  static bool is_bare(const Link& l) { return !l.has_inertial && l.visuals.empty() && l.collisions.empty(); }
  static bool has_mass(const Link& l) { return l.has_inertial && l.mass > 0.0; }

  void list_joints_below() {
    below_.assign(robot_.links.size(), {});
    for (std::size_t i = 0; i < ends_.size(); ++i)
      if (ends_[i].parent != kNone) below_[ends_[i].parent].push_back(i);
  }

  // A root that is but a name (`world`) for where the robot stands: the link that is fixed to it is the static one.
  void skip_empty_root() {
    while (is_bare(robot_.links[root_]) && below_[root_].size() == 1) {
      const std::size_t below = below_[root_].front();
      const Joint& joint = robot_.joints[below];
      if (joint.kind != JointKind::fixed && joint.kind != JointKind::floating) return;
      if (joint.kind == JointKind::floating) free_root_ = true;
      T_world_root_ = T_world_root_ * joint.origin;
      root_ = ends_[below].child;
      ends_[below].parent = kNone;
    }
  }

  // The link that `link` is part of by now. Paths are shortened on the way.
  std::size_t whole_of(std::size_t link, math::Pose& T_whole_link) {
    std::vector<std::size_t> path;
    for (; folds_[link].into != kNone; link = folds_[link].into) path.push_back(link);
    T_whole_link = {};
    for (auto at = path.rbegin(); at != path.rend(); ++at) {
      T_whole_link = T_whole_link * folds_[*at].T_into_link;
      folds_[*at].into = link;
      folds_[*at].T_into_link = T_whole_link;
    }
    return link;
  }

  // From the body that the parent is part of by now.
  void hang_on_whole(std::size_t i) {
    if (ends_[i].parent == kNone) return;
    math::Pose T_whole_parent;
    ends_[i].parent = whole_of(ends_[i].parent, T_whole_parent);
    robot_.joints[i].origin = T_whole_parent * robot_.joints[i].origin;
  }

  // A body without mass would be static: it becomes part of what a fixed joint connects it to. Masses only grow, so a
  // joint that need not be folded now never will be: one pass does.
  void fold(std::size_t i) {
    hang_on_whole(i);
    const Joint& joint = robot_.joints[i];
    Ends& ends = ends_[i];
    if (ends.parent == kNone || joint.kind != JointKind::fixed) return;
    Link &parent = robot_.links[ends.parent], &child = robot_.links[ends.child];
    const bool needed = !has_mass(child) || (!has_mass(parent) && ends.parent != root_);
    if (!needed && !treatment_.merge_fixed) return;
    add_inertia(parent, child, joint.origin);
    folds_[ends.child].into = ends.parent;
    folds_[ends.child].T_into_link = joint.origin;
    folds_[ends.parent].parts.emplace_back(ends.child, joint.origin);
    ends.parent = kNone;
  }

  // A link with the shapes of its parts behind its own.
  Link with_parts(std::size_t number) const {
    Link whole = robot_.links[number];
    std::vector<std::pair<std::size_t, math::Pose>> open;
    const auto add_parts = [&](std::size_t link, const math::Pose& T_whole_link) {
      const auto& parts = folds_[link].parts;
      for (auto part = parts.rbegin(); part != parts.rend(); ++part)
        open.emplace_back(part->first, T_whole_link * part->second);
    };
    add_parts(number, {});
    while (!open.empty()) {
      const auto [part, T_whole_part] = open.back();
      open.pop_back();
      for (auto shapes : {&Link::visuals, &Link::collisions}) {
        for (Shape shape : robot_.links[part].*shapes) {
          shape.origin = T_whole_part * shape.origin;
          (whole.*shapes).push_back(std::move(shape));
        }
      }
      add_parts(part, T_whole_part);
    }
    return whole;
  }

  void place() {
    std::vector<std::pair<std::size_t, math::Pose>> open{{root_, T_world_root_}};
    for (std::size_t i = 0; i < open.size(); ++i) {
      const auto [number, T_world_link] = open[i];
      PlannedBody body{with_parts(number), T_world_link, false};
      body.is_static = i == 0 && !treatment_.free_base && !free_root_;
      if (!body.is_static && !has_mass(body.link)) give_mass(body.link);
      plan_.bodies.push_back(std::move(body));
      for (const std::size_t below : below_[number]) {
        Joint joint = robot_.joints[below];
        joint.parent = robot_.links[number].name;
        open.emplace_back(ends_[below].child, T_world_link * joint.origin);
        if (joint.kind != JointKind::floating) plan_.joints.push_back(std::move(joint));
      }
    }
  }

  void give_mass(Link& l) const {
    constexpr double kMass = 1e-3, kInertia = 1e-6;  // kg, kg m^2: little beside any link, and stable in steps of 1 ms
    l.mass = kMass;
    l.inertia = {kInertia, 0.0, 0.0, kInertia, 0.0, kInertia};
    l.inertial = {};
    l.has_inertial = true;
    warn_(l.line, "link '" + l.name + "' has no mass; it gets 1 g, since a body without mass would be static",
          "give it `inertial`");
  }

  Robot robot_;
  const Treatment treatment_;
  const Warn& warn_;
  std::map<std::string, std::size_t> number_;    // of links, by name
  std::vector<Ends> ends_;                       // of joints
  std::vector<Fold> folds_;                      // of links
  std::vector<std::vector<std::size_t>> below_;  // joints below each link
  std::size_t root_ = 0;
  math::Pose T_world_root_;
  bool free_root_ = false;
  Plan plan_;
};

}  // namespace

Plan plan_of(Robot robot, const Treatment& treatment, const Warn& warn) {
  return Planner(std::move(robot), treatment, warn).plan();
}

// Jacobi's rotations: each makes one of the three products zero.
math::Vec3 principal_moments(const std::array<double, 6>& tensor, math::Quat& out_axes) {
  Matrix a = matrix_of(tensor);
  Matrix u{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int kSweeps = 30;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      if (a[p][q] == 0.0) continue;
      const double angle = 0.5 * std::atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
      const double c = std::cos(angle), s = std::sin(angle);
      for (int k = 0; k < 3; ++k) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
      }
      for (int k = 0; k < 3; ++k) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        const double up = u[k][p], uq = u[k][q];
        u[k][p] = c * up - s * uq;
        u[k][q] = s * up + c * uq;
      }
    }
  }
  const double m[9] = {u[0][0], u[0][1], u[0][2], u[1][0], u[1][1], u[1][2], u[2][0], u[2][1], u[2][2]};
  out_axes = math::from_matrix(m);
  return {a[0][0], a[1][1], a[2][2]};
}

}  // namespace ambf::adf::urdf
