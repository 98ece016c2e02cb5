// Long: one class, a function for each kind of block.
#include "adf/write.h"

#include <algorithm>
#include <map>

#include "adf/detail/text_edit.h"
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

std::string flow(const scene::Shaders& shaders) {
  if (!shaders.given()) return {};
  return adf::flow(WrittenKeys{{"path", as_scalar(shaders.path)},
                               {"vertex", as_scalar(shaders.vertex)},
                               {"fragment", as_scalar(shaders.fragment)}});
}

std::string flow(const scene::Color& c, const char* more = "") {
  return "{r: " + adf::flow(c.r) + ", g: " + adf::flow(c.g) + ", b: " + adf::flow(c.b) + more + "}";
}

std::string shape_word(const scene::Geometry& geometry) {
  return first_word(*scene::find_key(scene::group::kVisual, "shape"), static_cast<int>(geometry.shape));
}

std::string sizes_of(const scene::Geometry& g) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  using scene::Shape;
  switch (g.shape) {
    case Shape::box: return adf::flow(g.size);
    case Shape::sphere: return adf::flow(WrittenKeys{{"radius", adf::flow(g.radius)}});
    case Shape::plane: return adf::flow(WrittenKeys{{"normal", adf::flow(g.normal)}, {"offset", adf::flow(g.offset)}});
    case Shape::cylinder:
    case Shape::cone:
    case Shape::capsule: break;
  }
  return adf::flow(WrittenKeys{
      {"radius", adf::flow(g.radius)}, {"height", adf::flow(g.height)}, {"axis", kAxes[static_cast<int>(g.axis)]}});
}

std::string item(const scene::PlacedGeometry& placed) {
  WrittenKeys keys{{"shape", shape_word(placed.geometry)}, {"geometry", sizes_of(placed.geometry)}};
  if (!(placed.offset == math::Pose{})) keys.emplace_back("offset", adf::flow(placed.offset));
  return adf::flow(keys);
}

std::string item(const scene::PlacedMesh& placed) {
  WrittenKeys geometry{{"mesh", as_scalar(placed.file)}};
  if (!(placed.scale == math::Vec3{1.0, 1.0, 1.0})) geometry.emplace_back("scale", adf::flow(placed.scale));
  WrittenKeys keys{{"shape", "MESH"}, {"geometry", adf::flow(geometry)}};
  if (!(placed.offset == math::Pose{})) keys.emplace_back("offset", adf::flow(placed.offset));
  return adf::flow(keys);
}

std::string compound(const std::vector<scene::PlacedGeometry>& shapes, const std::vector<scene::PlacedMesh>& meshes) {
  std::string text;
  for (const auto& shape : shapes) text += (text.empty() ? "" : ", ") + item(shape);
  for (const auto& mesh : meshes) text += (text.empty() ? "" : ", ") + item(mesh);
  return "[" + text + "]";
}

bool is_single(const std::vector<scene::PlacedGeometry>& shapes, const std::vector<scene::PlacedMesh>& meshes) {
  return shapes.size() == 1 && meshes.empty() && shapes.front().offset == math::Pose{};
}

bool same(const scene::Color& a, const scene::Color& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

class Writer {
 public:
  explicit Writer(const scene::Model& model) : model_(model) {}

  WrittenModel run() {
    choose_namespace();
    out_ = "adf version: 1.0\n";
    if (!name_space_.empty()) out_ += "namespace: " + as_scalar(name_space_) + "\n";
    const WrittenKeys header = written_keys(scene::group::kModel, &model_, nullptr, [this](const Key& key) {
      if (is(key, scene::group::kModel, "shaders")) return std::optional(flow(model_.shaders));
      return std::optional<std::string>();
    });
    for (const auto& [name, value] : header) out_ += name + ": " + value + "\n";
    list("bodies", model_.bodies);
    list("joints", model_.joints);
    list("cameras", model_.cameras);
    list("lights", model_.lights);
    for (const scene::Body& body : model_.bodies) write(body);
    for (const scene::Joint& joint : model_.joints) write(joint);
    for (const scene::Camera& camera : model_.cameras) write(camera);
    for (const scene::Light& light : model_.lights) write(light);
    for (const scene::KindBlock& block : model_.blocks)
      lost(block.identity, "a " + std::string(block.kind->group->title) + " is not written",
           "save the file that describes it");
    return {std::move(out_), std::move(diagnostics_)};
  }

 private:
  template <class Objects>
  void list(const char* name, const Objects& objects) {
    if (objects.empty()) return;
    out_ += std::string(name) + ":\n";
    for (const auto& object : objects) out_ += "  - " + as_scalar(object.identity.identifier) + "\n";
  }

  template <class Visit>
  void each_identity(Visit visit) const {
    for (const auto& body : model_.bodies) visit(body.identity);
    for (const auto& joint : model_.joints) visit(joint.identity);
    for (const auto& camera : model_.cameras) visit(camera.identity);
    for (const auto& light : model_.lights) visit(light.identity);
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

  void begin(const scene::Identity& identity) {
    out_ += "\n" + as_scalar(identity.identifier) + ":\n";
    key("name", as_scalar(identity.name));
    if (identity.name_space != name_space_) key("namespace", as_scalar(identity.name_space));
    rows(scene::group::kIdentity, &identity, [](const Key&) { return std::optional<std::string>(); });
  }

  void key(std::string_view name, const std::string& value) { out_ += "  " + std::string(name) + ": " + value + "\n"; }

  void rows(const scene::Group& group, const void* object, const OwnKeys& own) {
    for (const auto& [name, value] : written_keys(group, object, nullptr, own)) key(name, value);
  }

  void write(const scene::Body& body) {
    begin(body.identity);
    write_visual(body);
    write_collision(body);
    if (body.visual.material) write_material(*body.visual.material, body.identity);
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

  void write_visual(const scene::Body& body) {
    const scene::Visual& visual = body.visual;
    const auto& group = scene::group::kVisual;
    const bool single = is_single(visual.shapes, visual.meshes);
    const bool several = !single && (!visual.shapes.empty() || !visual.meshes.empty());
    const bool collides =
        !body.collision.shapes.empty() || !body.collision.meshes.empty() || !body.collision.mesh_file.empty();
    // A mesh that is drawn would collide, too.
    const bool only_drawn = !single && !several && !visual.mesh_file.empty() && !collides;
    rows(group, &visual, [&](const Key& key) -> std::optional<std::string> {
      if (is(key, group, "mesh"))
        return single || several || only_drawn || visual.mesh_file.empty() ? "" : as_scalar(visual.mesh_file);
      if (is(key, group, "shape")) return single ? shape_word(visual.shapes.front().geometry) : "";
      if (is(key, group, "geometry")) return single ? sizes_of(visual.shapes.front().geometry) : "";
      if (is(key, group, "compound shape")) {
        if (only_drawn) return compound({}, {{visual.mesh_file, {}, {1.0, 1.0, 1.0}, {}}});
        return several ? compound(visual.shapes, visual.meshes) : "";
      }
      if (is(key, group, "shaders")) return flow(visual.shaders);
      return std::nullopt;
    });
  }

  void write_collision(const scene::Body& body) {
    const scene::Collision& collision = body.collision;
    const auto& group = scene::group::kCollision;
    const bool single = is_single(collision.shapes, collision.meshes);
    const bool several = !single && (!collision.shapes.empty() || !collision.meshes.empty());
    rows(group, &collision, [&](const Key& key) -> std::optional<std::string> {
      if (is(key, group, "collision groups")) {
        std::vector<std::string> groups;
        for (const int number : collision.groups) groups.push_back(std::to_string(number));
        return groups.empty() ? "" : adf::flow(groups);
      }
      if (is(key, group, "collision shape")) return single ? shape_word(collision.shapes.front().geometry) : "";
      if (is(key, group, "collision geometry")) return single ? sizes_of(collision.shapes.front().geometry) : "";
      if (is(key, group, "compound collision shape"))
        return several ? compound(collision.shapes, collision.meshes) : "";
      if (is(key, group, "collision mesh"))
        return single || several || collision.mesh_file.empty() ? "" : as_scalar(collision.mesh_file);
      return std::nullopt;
    });
  }

  void write_material(const scene::Material& material, const scene::Identity& identity) {
    scene::Material plain;
    plain.diffuse = material.diffuse;
    const auto part = [&](double factor) {
      return scene::Color{material.diffuse.r * factor, material.diffuse.g * factor, material.diffuse.b * factor};
    };
    constexpr double kAmbientOfPlain = 0.5;
    const bool usual = same(material.specular, plain.specular) && same(material.emission, plain.emission) &&
                       material.shininess == plain.shininess && material.metallic == plain.metallic;
    if (usual && same(material.ambient, part(kAmbientOfPlain)))
      return key("color rgba", flow(material.diffuse, (", a: " + adf::flow(material.alpha)).c_str()));
    WrittenKeys keys{{"diffuse", flow(material.diffuse)},
                     {"specular", flow(material.specular)},
                     {"emission", flow(material.emission)}};
    if (!same(material.ambient, plain.ambient)) {
      const scene::Color& d = material.diffuse;
      const double level = d.r > 0.0   ? material.ambient.r / d.r
                           : d.g > 0.0 ? material.ambient.g / d.g
                           : d.b > 0.0 ? material.ambient.b / d.b
                                       : 0.0;
      keys.emplace_back("ambient", adf::flow(WrittenKeys{{"level", adf::flow(level)}}));
      constexpr double kSame = 1e-12;
      const scene::Color reads = part(level);
      if (std::max({reads.r - material.ambient.r, material.ambient.r - reads.r, reads.g - material.ambient.g,
                    material.ambient.g - reads.g, reads.b - material.ambient.b, material.ambient.b - reads.b}) > kSame)
        lost(identity, "its ambient colour is no part of the diffuse one", "ADF has a level only");
    }
    keys.emplace_back("shininess", std::to_string(material.shininess));
    keys.emplace_back("transparency", adf::flow(material.alpha));
    if (material.metallic != 0.0) keys.emplace_back("metallic", adf::flow(material.metallic));
    key("color components", adf::flow(keys));
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
    if (!(camera.lens.optics == state::Optics{}))
      lost(camera.identity, "its intrinsics are not written", "save the file that describes it");
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
      if (is(key, group, "orthographic view width") && !camera.lens.orthographic) return "";
      if (is(key, group, "preprocessing shaders")) return flow(camera.preprocessing_shaders);
      if (is(key, group, "depth compute shaders")) return flow(camera.depth_compute_shaders);
      return std::nullopt;
    });
  }

  void write(const scene::Light& light) {
    begin(light.identity);
    rows(scene::group::kLight, &light, [](const Key&) { return std::optional<std::string>(); });
  }

  const scene::Model& model_;
  std::string name_space_, out_;
  base::Diagnostics diagnostics_;
};

}  // namespace

WrittenModel write_model(const scene::Model& model) { return Writer(model).run(); }

}  // namespace ambf::adf
