// Long: one class, a function for each kind of block.
#include "adf/write.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "adf/detail/text_edit.h"
#include "adf/detail/write_blocks.h"
#include "adf/detail/write_looks.h"
#include "adf/detail/write_rows.h"
#include "scene/block_kinds.h"

namespace ambf::adf {

namespace {

using scene::ControllerOutput;
using scene::Key;
using state::JointType;

// A key by its place in the table: names repeat.
bool is(const Key& key, const scene::Group& group, std::string_view name) {
  return &key == scene::find_key(group, name);
}

std::string output_word(ControllerOutput output) {
  const Key* key = scene::find_key(scene::group::kBody, "controller output type");
  return first_word(*key, static_cast<int>(output));
}

class Writer {
 public:
  explicit Writer(const scene::Model& model) : model_(model) {}

  WrittenModel run() {
    choose_namespace();
    out_ = "adf version: 1.0\n";
    if (!name_space_.empty()) out_ += "namespace: " + as_scalar(name_space_) + "\n";
    const WrittenKeys header = written_keys(scene::group::kModel, &model_, nullptr, [this](const Key& key) {
      if (is(key, scene::group::kModel, "shaders")) return std::optional(adf::flow(model_.shaders));
      return std::optional<std::string>();
    });
    for (const auto& [name, value] : header) out_ += name + ": " + value + "\n";
    find_parts_of_blocks();
    for (const scene::BlockKind* kind : scene::block_kinds()) write_list(*kind);
    for (const scene::Body& body : model_.bodies)
      if (!wheels_.contains(body.identity.identifier)) write(body);
    for (const scene::Joint& joint : model_.joints) write(joint);
    for (const scene::Camera& camera : model_.cameras) write(camera);
    for (const scene::Light& light : model_.lights) write(light);
    for (const scene::KindBlock& block : model_.blocks)
      if (!is_surface(block)) write(block);
    return {std::move(out_), std::move(diagnostics_)};
  }

 private:
  // What other blocks make: resistive surfaces stand in their bodies, bodies that are drawn as wheels in vehicles.
  void find_parts_of_blocks() {
    for (const scene::KindBlock& block : model_.blocks) {
      if (const scene::Body* body = body_of_surface(block, model_.bodies))
        surfaces_.emplace(body->identity.identifier, &block);
      for (std::string& wheel : drawn_wheels(block)) wheels_.insert(std::move(wheel));
    }
  }

  bool is_surface(const scene::KindBlock& block) const {
    return std::any_of(surfaces_.begin(), surfaces_.end(), [&](const auto& each) { return each.second == &block; });
  }

  void write_list(const scene::BlockKind& kind) {
    std::vector<std::string> names;
    const auto add = [&](const scene::Group& group, const auto& objects) {
      if (kind.group != &group) return;
      for (const auto& object : objects) names.push_back(object.identity.identifier);
    };
    add(scene::group::kBody, model_.bodies);
    std::erase_if(names, [this](const std::string& name) { return wheels_.contains(name); });
    add(scene::group::kJoint, model_.joints);
    add(scene::group::kCamera, model_.cameras);
    add(scene::group::kLight, model_.lights);
    for (const scene::KindBlock& block : model_.blocks)
      if (block.kind == &kind && !is_surface(block)) names.push_back(block.identity.identifier);
    if (names.empty()) return;
    out_ += std::string(kind.list.name) + ":\n";
    for (const std::string& name : names) out_ += "  - " + as_scalar(name) + "\n";
  }

  template <class Visit>
  void each_identity(Visit visit) const {
    for (const auto& body : model_.bodies) visit(body.identity);
    for (const auto& joint : model_.joints) visit(joint.identity);
    for (const auto& camera : model_.cameras) visit(camera.identity);
    for (const auto& light : model_.lights) visit(light.identity);
    for (const auto& block : model_.blocks) visit(block.identity);
  }

  // That of most blocks, where the others' can then be written: behind a file's namespace stand only absolute ones.
  void choose_namespace() {
    std::map<std::string, std::size_t> counts;
    bool all_absolute = true;
    each_identity([&](const scene::Identity& identity) {
      ++counts[identity.name_space];
      all_absolute &= identity.name_space.starts_with('/');
    });
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most != counts.end() && (counts.size() == 1 || all_absolute)) name_space_ = most->first;
  }

  void lost(const scene::Identity& at, const std::string& what, const std::string& hint) {
    diagnostics_.push_back(
        {base::Severity::error, model_.file, at.where.line, at.where.column, at.identifier, "", what, hint});
  }

  Lost lost_by(const scene::Identity& at) {
    return [this, &at](const std::string& what, const std::string& hint) { lost(at, what, hint); };
  }

  void begin(const scene::Identity& identity) {
    out_ += "\n" + as_scalar(identity.identifier) + ":\n";
    key("name", as_scalar(identity.name));
    if (identity.name_space != name_space_) key("namespace", as_scalar(identity.name_space));
    rows(scene::group::kIdentity, &identity, [](const Key&) { return std::optional<std::string>(); });
  }

  void key(std::string_view name, const std::string& value) { out_ += "  " + std::string(name) + ": " + value + "\n"; }

  void keys(const WrittenKeys& written) {
    for (const auto& [name, value] : written) key(name, value);
  }

  void rows(const scene::Group& group, const void* object, const OwnKeys& own) {
    keys(written_keys(group, object, nullptr, own));
  }

  void write(const scene::Body& body) {
    begin(body.identity);
    const Lost lost_of = lost_by(body.identity);
    keys(visual_keys(body.visual, collides(body.collision), lost_of));
    keys(collision_keys(body.collision));
    if (body.visual.material) keys(material_keys(*body.visual.material, lost_of));
    const auto& group = scene::group::kBody;
    const Channels channels = channels_of(body);
    rows(group, &body, [&](const Key& key) -> std::optional<std::string> {
      if (is(key, group, "mass")) return adf::flow(body.mass);
      if (is(key, group, "inertia")) {
        if (!body.inertia) return "";
        const math::Vec3& i = *body.inertia;
        return adf::flow(WrittenKeys{{"ix", adf::flow(i.x)}, {"iy", adf::flow(i.y)}, {"iz", adf::flow(i.z)}});
      }
      if (is(key, group, "controller")) return channels.controller;
      if (is(key, group, "controller output type")) return channels.output;
      if (is(key, group, "resistive surface")) {
        const auto surface = surfaces_.find(body.identity.identifier);
        return surface == surfaces_.end() ? "" : surface_keys(*surface->second);
      }
      return std::nullopt;
    });
  }

  struct Channels {
    std::string controller, output;
  };
  // A channel that is given makes forces; one key says another output for both.
  Channels channels_of(const scene::Body& body) {
    const auto gains = [](const scene::ChannelGains& g) {
      return adf::flow(WrittenKeys{{"P", adf::flow(g.p)}, {"I", adf::flow(g.i)}, {"D", adf::flow(g.d)}});
    };
    const auto usual = [](const scene::ChannelGains& g) {
      const scene::ChannelGains unchanged;
      return g.output == unchanged.output && g.p == unchanged.p && g.i == unchanged.i && g.d == unchanged.d;
    };
    WrittenKeys keys;
    if (!usual(body.linear)) keys.emplace_back("linear", gains(body.linear));
    if (!usual(body.angular)) keys.emplace_back("angular", gains(body.angular));
    if (keys.empty()) return {};
    Channels out{adf::flow(keys), ""};
    if (body.linear.output == body.angular.output) {
      if (body.linear.output != ControllerOutput::force || keys.size() == 1)
        out.output = output_word(body.linear.output);
    } else {
      const auto fits = [&](const scene::ChannelGains& g) { return usual(g) || g.output == ControllerOutput::force; };
      if (!fits(body.linear) || !fits(body.angular))
        lost(body.identity, "outputs of its controllers differ in a way that no key says", "give both one output");
    }
    return out;
  }

  void write(const scene::Joint& joint) {
    begin(joint.identity);
    const auto& group = scene::group::kJoint;
    const bool cone = joint.type == JointType::cone_twist, spring_six = joint.type == JointType::six_dof_spring;
    const bool six = joint.type == JointType::six_dof || spring_six;
    const state::JointGains usual;
    const bool gains = joint.controller.p != usual.p || joint.controller.i != usual.i ||
                       joint.controller.d != usual.d || joint.controller.output == ControllerOutput::force;
    const auto of_six = [](const math::Vec3& linear, const math::Vec3& angular) {
      return adf::flow(WrittenKeys{{"linear", adf::flow(linear)}, {"angular", adf::flow(angular)}});
    };
    const auto range = [](const math::Vec3& low, const math::Vec3& high) {
      return adf::flow(WrittenKeys{{"low", adf::flow(low)}, {"high", adf::flow(high)}});
    };
    rows(group, &joint, [&](const Key& key) -> std::optional<std::string> {
      if (is(key, group, "type")) return first_word(key, static_cast<int>(joint.type));
      if (is(key, group, "parent axis")) return adf::flow(joint.parent_axis);
      if (is(key, group, "child axis")) return adf::flow(joint.child_axis);
      if (is(key, group, "joint limits")) {
        if (cone) return std::nullopt;
        if (six)
          return adf::flow(WrittenKeys{{"linear", range(joint.six_dof.linear_low, joint.six_dof.linear_high)},
                                       {"angular", range(joint.six_dof.angular_low, joint.six_dof.angular_high)}});
        if (!joint.limits) return "";
        return adf::flow(WrittenKeys{{"low", adf::flow((*joint.limits)[0])}, {"high", adf::flow((*joint.limits)[1])}});
      }
      if (is(key, group, "controller")) {
        if (!gains) return "";
        const state::JointGains& g = joint.controller;
        return adf::flow(WrittenKeys{{"P", adf::flow(g.p)}, {"I", adf::flow(g.i)}, {"D", adf::flow(g.d)}});
      }
      if (is(key, group, "controller output type")) {
        const ControllerOutput given = gains ? ControllerOutput::force : ControllerOutput::velocity;
        return joint.controller.output == given ? "" : output_word(joint.controller.output);
      }
      if (is(key, group, "damping"))
        return spring_six           ? of_six(joint.spring.linear_damping, joint.spring.angular_damping)
               : joint.damping != 0 ? adf::flow(joint.damping)
                                    : "";
      if (is(key, group, "stiffness"))
        return spring_six             ? of_six(joint.spring.linear_stiffness, joint.spring.angular_stiffness)
               : joint.stiffness != 0 ? adf::flow(joint.stiffness)
                                      : "";
      if (is(key, group, "equilibrium point"))
        return spring_six          ? of_six(joint.spring.linear_equilibrium, joint.spring.angular_equilibrium)
               : joint.equilibrium ? adf::flow(*joint.equilibrium)
                                   : "";
      if (is(key, group, "mimic") && joint.mimic.joint.empty()) return "";
      return std::nullopt;
    });
  }

  void write(const scene::Camera& camera) {
    begin(camera.identity);
    const auto& group = scene::group::kCamera;
    const bool has_optics = !(camera.lens.optics == state::Optics{});
    rows(group, &camera, [&](const Key& key) -> std::optional<std::string> {
      if (is(key, group, "location")) return adf::flow(camera.location);
      if (is(key, group, "look at")) return adf::flow(camera.look_at);
      if (is(key, group, "publish depth noise")) {
        if (!camera.depth_noise.on) return "";
        const state::DepthNoise& noise = camera.depth_noise;
        return adf::flow(WrittenKeys{
            {"mean", adf::flow(noise.mean)}, {"std_dev", adf::flow(noise.std_dev)}, {"bias", adf::flow(noise.bias)}});
      }
      if (is(key, group, "stereo")) {
        if (!camera.lens.stereo) return std::nullopt;
        return adf::flow(WrittenKeys{{"mode", "PASSIVE"},
                                     {"eye separation", adf::flow(camera.lens.eye_separation_m)},
                                     {"focal length", adf::flow(camera.lens.focal_length_m)}});
      }
      if (has_optics && is(key, group, "field view angle")) return "";
      if (has_optics && is(key, group, "camera intrinsics")) return intrinsics(camera);
      if (is(key, group, "window resolution")) {
        // Without one of their own, pictures have that of the window, too.
        const state::ImageStream usual;
        const bool is_usual = camera.image.width == usual.width && camera.image.height == usual.height;
        return has_optics && !is_usual ? resolution(camera.image) : "";
      }
      if (is(key, group, "orthographic view width") && !camera.lens.orthographic) return "";
      if (is(key, group, "preprocessing shaders")) return adf::flow(camera.preprocessing_shaders);
      if (is(key, group, "depth compute shaders")) return adf::flow(camera.depth_compute_shaders);
      return std::nullopt;
    });
  }

  static std::string resolution(const state::ImageStream& image) {
    return adf::flow(WrittenKeys{{"width", std::to_string(image.width)}, {"height", std::to_string(image.height)}});
  }

  // For pictures of the published size, which is written as that of the window; what the parser does, turned round.
  static std::string intrinsics(const scene::Camera& camera) {
    const double width = camera.image.width, height = camera.image.height;
    const state::Optics& optics = camera.lens.optics;
    const double fy = 0.5 * height / std::tan(0.5 * camera.lens.field_of_view_rad);
    return adf::flow(WrittenKeys{{"fx", adf::flow(optics.focal_ratio * fy)},
                                 {"fy", adf::flow(fy)},
                                 {"cx", adf::flow(0.5 * width + optics.axis_right * height)},
                                 {"cy", adf::flow(0.5 * height + optics.axis_down * height)},
                                 {"s", adf::flow(-optics.skew * fy)}});
  }

  void write(const scene::Light& light) {
    begin(light.identity);
    rows(scene::group::kLight, &light, [](const Key&) { return std::optional<std::string>(); });
  }

  void write(const scene::KindBlock& block) {
    begin(block.identity);
    keys(block_keys(block, model_.bodies, lost_by(block.identity)));
  }

  const scene::Model& model_;
  std::map<std::string, const scene::KindBlock*> surfaces_;  // by the identifier of their body
  std::set<std::string> wheels_;                             // identifiers
  std::string name_space_, out_;
  base::Diagnostics diagnostics_;
};

}  // namespace

WrittenModel write_model(const scene::Model& model) { return Writer(model).run(); }

}  // namespace ambf::adf
