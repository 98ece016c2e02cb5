#include "adf/detail/urdf_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "adf/detail/exact_rpy.h"
#include "adf/detail/files.h"
#include "math/rotation.h"

namespace ambf::adf::urdf {

namespace {

using math::Pose;
using math::Vec3;

// The shortest text that reads back to the same bits.
template <typename Number>
std::string text_of(Number value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value == Number{} ? Number{} : value).ptr;
  return {digits, end};
}

std::string text_of(const Vec3& v) {
  return "{x: " + text_of(v.x) + ", y: " + text_of(v.y) + ", z: " + text_of(v.z) + "}";
}

std::string rpy_of(const math::Quat& q) {
  const Vec3 rpy = exact_rpy(q);
  return "{r: " + text_of(rpy.x) + ", p: " + text_of(rpy.y) + ", y: " + text_of(rpy.z) + "}";
}

std::string text_of(const Pose& p) {
  return "{position: " + text_of(p.position) + ", orientation: " + rpy_of(p.orientation) + "}";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

// One scale for all axes; 0: there is none.
double uniform_scale(const Shape& mesh) {
  const Vec3& s = mesh.size;
  return s.x > 0.0 && s.x == s.y && s.x == s.z ? s.x : 0.0;
}

class Writer {
 public:
  Writer(const Plan& plan, const Paths& paths, const Warn& warn) : plan_(plan), paths_(paths), warn_(warn) {
    for (const PlannedBody& body : plan.bodies) body_[body.link.name] = &body;
    for (const Joint& joint : plan.joints) joints_.insert(joint.name);
  }

  Written write(const std::string& robot) {
    out_ = "# Made from the URDF robot " + quoted(robot) + ".\nadf version: 1.0\nnamespace: /ambf/env/\n" +
           "ignore inter-collision: true\nbodies:\n";
    for (const PlannedBody& body : plan_.bodies) out_ += "  - " + quoted("BODY " + body.link.name) + "\n";
    if (plan_.bodies.empty()) out_ += "  []\n";
    out_ += plan_.joints.empty() ? "joints: []\n" : "joints:\n";
    for (const Joint& joint : plan_.joints) out_ += "  - " + quoted("JOINT " + joint.name) + "\n";
    for (const PlannedBody& body : plan_.bodies) write_body(body);
    for (const Joint& joint : plan_.joints) write_joint(joint);
    return {std::move(out_), std::move(lines_)};
  }

 private:
  void key(const std::string& name, const std::string& value) { out_ += "  " + name + ": " + value + "\n"; }

  void begin(const std::string& block, int line) {
    out_ += "\n" + quoted(block) + ":\n";
    lines_[block] = line;
  }

  std::string found(const std::string& mesh) const {
    const std::vector<std::string> places = mesh_places(mesh, paths_.urdf);
    std::string file = find_file(places);
    if (file.empty()) file = places.front();
    if (!paths_.adf.empty()) return seen_from(folder_of(paths_.adf), file);
    // The text may be read from anywhere: a path from the working folder would be taken from there.
    std::error_code problem;
    return std::filesystem::absolute(file, problem).lexically_normal().string();
  }

  // The one mesh that is drawn, where nothing but ADF's plainest form is needed: the body is then described in the
  // mesh's frame, as `mesh` has no offset. Everything else becomes compounds in the link's frame.
  const Shape* drawn_mesh(const Link& link) const {
    if (link.visuals.size() != 1 || link.visuals.front().kind != ShapeKind::mesh) return nullptr;
    const double scale = uniform_scale(link.visuals.front());
    const auto is_mesh = [](const Shape& s) { return s.kind == ShapeKind::mesh; };
    const bool one_mesh = link.collisions.size() == 1 && is_mesh(link.collisions.front()) &&
                          uniform_scale(link.collisions.front()) == scale;
    // `scale` would act on primitives, too.
    const bool primitives = std::none_of(link.collisions.begin(), link.collisions.end(), is_mesh) &&
                            (link.collisions.empty() || scale == 1.0);
    return scale > 0.0 && (one_mesh || primitives) ? &link.visuals.front() : nullptr;
  }

  Pose T_link_body(const Link& link) const {
    const Shape* mesh = drawn_mesh(link);
    return mesh == nullptr ? Pose{} : mesh->origin;
  }

  double scale_of(const Link& link) const {
    const Shape* mesh = drawn_mesh(link);
    return mesh == nullptr ? 1.0 : uniform_scale(*mesh);
  }

  void write_body(const PlannedBody& body) {
    const Link& link = body.link;
    const Pose T_body_link = math::inverse(T_link_body(link));
    begin("BODY " + link.name, link.line);
    key("name", quoted(link.name));
    key("mass", text_of(body.is_static ? 0.0 : link.mass));
    if (link.has_inertial && link.mass > 0.0) write_inertia(body, T_body_link);
    key("location", text_of(body.T_world_link * T_link_body(link)));
    write_visuals(link);
    write_collisions(link, T_body_link);
  }

  void write_inertia(const PlannedBody& body, const Pose& T_body_link) {
    const Link& link = body.link;
    math::Quat axes;
    const Vec3 moments = principal_moments(link.inertia, axes);
    const bool usable = std::min({moments.x, moments.y, moments.z}) > 0.0;
    if (usable && !body.is_static) {
      key("inertia",
          "{ix: " + text_of(moments.x) + ", iy: " + text_of(moments.y) + ", iz: " + text_of(moments.z) + "}");
    } else if (!body.is_static) {
      warn_(link.line, "the inertia of link '" + link.name + "' has a principal moment that is not above 0",
            "that of its collision shape is used");
    }
    const Pose turn{{}, usable ? axes : math::Quat{}};
    key("inertial offset", text_of(T_body_link * link.inertial * turn));
  }

  std::string item(const Shape& s, const Pose& T_body_shape, const std::string& color = {}) const {
    std::string text;
    if (s.kind == ShapeKind::box) text = "shape: BOX, geometry: " + text_of(s.size);
    if (s.kind == ShapeKind::sphere) text = "shape: SPHERE, geometry: {radius: " + text_of(s.size.x) + "}";
    if (s.kind == ShapeKind::cylinder) {
      text =
          "shape: CYLINDER, geometry: {radius: " + text_of(s.size.x) + ", height: " + text_of(s.size.z) + ", axis: z}";
    }
    if (s.kind == ShapeKind::mesh) {
      text = "shape: MESH, geometry: {mesh: " + quoted(found(s.file));
      if (s.size != Vec3{1.0, 1.0, 1.0}) text += ", scale: " + text_of(s.size);
      text += "}";
    }
    text += ", offset: " + text_of(T_body_shape);
    if (!color.empty()) text += ", color rgba: " + color;
    return "    - {" + text + "}\n";
  }

  // Whether it has an extent. Nothing silent: a mesh without one is said to be left out.
  bool usable(const Link& link, const Shape& s, const std::string& what) const {
    const bool flat = s.kind == ShapeKind::mesh && s.size.x * s.size.y * s.size.z == 0.0;
    if (flat) {
      warn_(s.line, "link '" + link.name + "': a " + what + " mesh with a scale of 0 is left out",
            "give each axis a scale; 1 leaves it as it is");
    }
    return s.kind != ShapeKind::none && !flat;
  }

  // Empty where it has none.
  std::string color_of(const Shape& s) const {
    if (!s.texture.empty())
      warn_(s.line, "the texture of a material is not drawn", "give the mesh a texture of its own");
    if (!s.colored || (!s.texture.empty() && s.rgba == std::array<float, 4>{})) return {};
    return "{r: " + text_of(s.rgba[0]) + ", g: " + text_of(s.rgba[1]) + ", b: " + text_of(s.rgba[2]) +
           ", a: " + text_of(s.rgba[3]) + "}";
  }

  // One colour of all visuals is the body's, for files that are easy to edit; others stand beside what has them.
  void write_visuals(const Link& link) {
    if (const Shape* mesh = drawn_mesh(link)) {
      key("mesh", quoted(found(mesh->file)));
      if (uniform_scale(*mesh) != 1.0) key("scale", text_of(uniform_scale(*mesh)));
      if (const std::string color = color_of(*mesh); !color.empty()) key("color rgba", color);
      return;
    }
    std::vector<std::pair<const Shape*, std::string>> drawn;
    for (const Shape& s : link.visuals)
      if (usable(link, s, "visual")) drawn.emplace_back(&s, color_of(s));
    if (drawn.empty()) return;
    const std::string& first = drawn.front().second;
    const bool same = std::all_of(drawn.begin(), drawn.end(), [&](const auto& each) { return each.second == first; });
    out_ += "  compound shape:\n";
    for (const auto& [shape, color] : drawn) out_ += item(*shape, shape->origin, same ? std::string() : color);
    if (same && !first.empty()) key("color rgba", first);
  }

  void write_collisions(const Link& link, const Pose& T_body_link) {
    const bool is_plain = drawn_mesh(link) != nullptr;
    if (is_plain && link.collisions.size() == 1 && link.collisions.front().kind == ShapeKind::mesh) {
      const Shape& mesh = link.collisions.front();
      key("collision mesh", quoted(found(mesh.file)));
      key("collision mesh type", "CONVEX_HULL");
      key("collision offset", text_of(T_body_link * mesh.origin));
      return;
    }
    std::string shapes;
    std::vector<const Shape*> used;
    for (const Shape& s : link.collisions) {
      if (!usable(link, s, "collision")) continue;
      shapes += item(s, T_body_link * s.origin);
      used.push_back(&s);
    }
    if (!used.empty()) {
      out_ += "  compound collision shape:\n" + shapes;
      // Else one primitive at the origin would go to the centre of mass.
      if (used.size() == 1 && used.front()->kind != ShapeKind::mesh)
        key("collision offset", text_of(T_body_link * used.front()->origin));
    } else if (is_plain) {
      key("collision groups", "[" + std::to_string(999 - untouchable_++ % 900) + "]");  // else its mesh would collide
    }
  }

  void write_joint(const Joint& joint) {
    const Link &parent = body_.at(joint.parent)->link, &child = body_.at(joint.child)->link;
    const Pose T_p_j = math::inverse(T_link_body(parent)) * joint.origin;
    const Pose T_c_j = math::inverse(T_link_body(child));
    if (joint.kind != JointKind::fixed && math::norm(joint.axis) == 0.0)
      warn_(joint.line, "the axis of joint '" + joint.name + "' is the zero vector", "x is taken");
    const Vec3 unit = joint.kind == JointKind::fixed ? Vec3{0, 0, 1} : math::normalized(joint.axis, {1, 0, 0});
    const Vec3 parent_axis = math::rotate(T_p_j.orientation, unit), child_axis = math::rotate(T_c_j.orientation, unit);
    // Alg. 3 with a signed angle: what the shortest rotation between the axes leaves of the joint's rotation.
    const math::Quat R_shortest = math::rotation_between(child_axis, parent_axis);
    const math::Quat R_parent_child = T_p_j.orientation * math::inverse(T_c_j.orientation);
    const double offset = math::dot(math::log(math::inverse(R_shortest) * R_parent_child), child_axis);

    begin("JOINT " + joint.name, joint.line);
    key("name", quoted(joint.name));
    key("parent", quoted("BODY " + joint.parent));
    key("child", quoted("BODY " + joint.child));
    key("type", type_of(joint));
    key("parent pivot", text_of(T_p_j.position * (1.0 / scale_of(parent))));
    key("child pivot", text_of(T_c_j.position * (1.0 / scale_of(child))));
    key("parent axis", text_of(parent_axis));
    key("child axis", text_of(child_axis));
    key("offset", text_of(offset));
    const bool one_axis =
        joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic || joint.kind == JointKind::continuous;
    if (joint.has_limits && one_axis && joint.kind != JointKind::continuous)
      key("joint limits", "{low: " + text_of(joint.lower) + ", high: " + text_of(joint.upper) + "}");
    if (joint.kind == JointKind::planar) write_plane();
    if (joint.has_mimic && one_axis) write_mimic(joint);
    if (joint.damping > 0.0 && one_axis) key("damping", text_of(joint.damping));
    // Effort acts for a step of 1 ms.
    if (joint.effort > 0.0 && one_axis) key("max motor impulse", text_of(1e-3 * joint.effort));
  }

  void write_mimic(const Joint& joint) {
    if (joints_.count(joint.mimic_joint) == 0) {
      warn_(joint.line, "joint '" + joint.name + "' mimics '" + joint.mimic_joint + "', which is no joint that moves",
            "it moves freely");
      return;
    }
    key("mimic", "{joint: " + quoted("JOINT " + joint.mimic_joint) + ", multiplier: " +
                     text_of(joint.mimic_multiplier) + ", offset: " + text_of(joint.mimic_offset) + "}");
  }

  static std::string type_of(const Joint& joint) {
    if (joint.kind == JointKind::fixed) return "fixed";
    if (joint.kind == JointKind::prismatic) return "prismatic";
    return joint.kind == JointKind::planar ? "six dof" : "revolute";
  }

  // The joint's z is the normal: free are the two directions in the plane and the turn about the normal.
  void write_plane() {
    const std::string all = text_of(Vec3{1000, 1000, 0}), none = text_of(Vec3{-1000, -1000, 0});
    const double turn = 3.14;
    key("joint limits", "{linear: {low: " + none + ", high: " + all + "}, angular: {low: " +
                            text_of(Vec3{0, 0, -turn}) + ", high: " + text_of(Vec3{0, 0, turn}) + "}}");
  }

  const Plan& plan_;
  const Paths& paths_;
  const Warn& warn_;
  std::map<std::string, const PlannedBody*> body_;  // by the link's name
  std::set<std::string> joints_;                    // names
  std::string out_;
  std::map<std::string, int> lines_;
  int untouchable_ = 0;
};

}  // namespace

Written write_adf(const Plan& plan, const std::string& robot, const Paths& paths, const Warn& warn) {
  return Writer(plan, paths, warn).write(robot);
}

}  // namespace ambf::adf::urdf
