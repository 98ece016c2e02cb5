#include "urdf_reader.h"

#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

namespace ambf::file_reader {

namespace {

using adf::urdf::JointKind;
using adf::urdf::Robot;
using adf::urdf::ShapeKind;

// urdfdom reports through console_bridge; the last error is the reason.
class Messages : public console_bridge::OutputHandler {
 public:
  Messages() { console_bridge::useOutputHandler(this); }
  ~Messages() override { console_bridge::noOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level != console_bridge::CONSOLE_BRIDGE_LOG_ERROR || text.empty()) return;
    if (!errors_.empty()) errors_ += "; ";
    errors_ += text;
  }
  const std::string& errors() const { return errors_; }

 private:
  std::string errors_;
};

// Where elements are nested deeper than `most` (TinyXML recurses); npos: nowhere.
std::size_t too_deep(std::string_view text, int most) {
  int depth = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::string_view rest = text.substr(at);
    const auto skip_to = [&](std::string_view end) {
      const std::size_t found = text.find(end, at);
      at = found == std::string_view::npos ? text.size() - 1 : found;
    };
    if (rest.substr(0, 4) == "<!--") {
      skip_to("-->");
    } else if (rest.substr(0, 9) == "<![CDATA[") {
      skip_to("]]>");
    } else if (rest.substr(0, 2) == "</") {
      --depth;
    } else if (rest.substr(0, 2) != "<?" && rest.substr(0, 2) != "<!") {
      const std::size_t end = text.find('>', at);
      if (end == std::string_view::npos || text[end - 1] != '/') ++depth;
      if (depth > most) return at;
    }
  }
  return std::string_view::npos;
}

// TinyXML knows no DTD: spaces in its place, so that lines and columns stay.
std::string without_doctype(std::string text) {
  const std::size_t start = text.find("<!DOCTYPE");
  const std::size_t root = text.find("<robot");
  if (start == std::string::npos || start > root) return text;
  int inside = 0;  // brackets
  for (std::size_t at = start; at < text.size(); ++at) {
    const char c = text[at];
    inside += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c != '\n' && c != '\r') text[at] = ' ';
    if (c == '>' && inside == 0) break;
  }
  return text;
}

int line_at(std::string_view text, std::size_t place) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
}

math::Pose pose_of(const urdf::Pose& p) {
  return {{p.position.x, p.position.y, p.position.z}, {p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w}};
}

math::Vec3 vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

// Visual or Collision.
template <typename Part>
adf::urdf::Shape shape_of(const Part& part) {
  adf::urdf::Shape shape;
  shape.origin = pose_of(part.origin);
  if (part.geometry == nullptr) return shape;
  if (const auto* box = dynamic_cast<const urdf::Box*>(part.geometry.get())) {
    shape.kind = ShapeKind::box;
    shape.size = vector_of(box->dim);
  } else if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(part.geometry.get())) {
    shape.kind = ShapeKind::sphere;
    shape.size.x = sphere->radius;
  } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(part.geometry.get())) {
    shape.kind = ShapeKind::cylinder;
    shape.size = {cylinder->radius, 0.0, cylinder->length};
  } else if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(part.geometry.get())) {
    shape.kind = ShapeKind::mesh;
    shape.size = vector_of(mesh->scale);
    shape.file = mesh->filename;
  }
  return shape;
}

class UrdfReader {
 public:
  explicit UrdfReader(const std::string& text) : text_(without_doctype(text)) {}

  Robot read() {
    constexpr int kMaxDepth = 200;
    if (const std::size_t deep = too_deep(text_, kMaxDepth); deep != std::string::npos)
      return refuse("elements are nested more than 200 deep", line_at(text_, deep), 0);
    TiXmlDocument xml;
    xml.Parse(text_.c_str());
    const TiXmlElement* root = xml.RootElement();
    // What is not closed is missed at the end.
    if (xml.Error())
      return refuse(xml.ErrorDesc(), xml.ErrorRow() > 0 ? xml.ErrorRow() : line_at(text_, text_.size()),
                    xml.ErrorCol());
    if (root == nullptr || root->ValueStr() != "robot") return refuse("expected an element `robot`", 1, 1);
    walk(*root);
    look_at_materials(*root);
    Messages messages;
    const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text_);
    if (model == nullptr || model->getRoot() == nullptr) {
      const std::string why = messages.errors().empty() ? "urdfdom refuses it" : messages.errors();
      const TiXmlElement* at = named_in(why);
      return refuse(why, at == nullptr ? root->Row() : at->Row(), at == nullptr ? root->Column() : at->Column());
    }
    convert(*model);
    return std::move(robot_);
  }

 private:
  Robot refuse(const std::string& why, int line, int column) const {
    Robot robot;
    robot.error = why;
    robot.error_line = line;
    robot.error_column = column;
    return robot;
  }

  void count(const std::string& what, int line) {
    for (adf::urdf::Unused& known : robot_.unused) {
      if (known.what != what) continue;
      ++known.count;
      return;
    }
    robot_.unused.push_back({what, 1, line});
  }

  void walk(const TiXmlElement& root) {
    for (const TiXmlElement* e = root.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const char* name = e->Attribute("name");
      if (e->ValueStr() == "link") {
        links_.emplace(name == nullptr ? "" : name, e);
      } else if (e->ValueStr() == "joint") {
        joints_.emplace(name == nullptr ? "" : name, e);
        const TiXmlElement* limit = e->FirstChildElement("limit");
        if (limit != nullptr && limit->Attribute("velocity") != nullptr) count("limits of velocity", limit->Row());
        const TiXmlElement* dynamics = e->FirstChildElement("dynamics");
        if (dynamics != nullptr && dynamics->Attribute("friction") != nullptr) count("joint friction", dynamics->Row());
        for (const char* unused : {"safety_controller", "calibration"}) {
          if (const TiXmlElement* found = e->FirstChildElement(unused)) count(element(unused), found->Row());
        }
      } else if (e->ValueStr() != "material") {
        count(element(e->ValueStr()), e->Row());
      }
    }
  }

  // urdfdom leaves out without a word what it cannot read of a material.
  void look_at_materials(const TiXmlElement& root) {
    std::set<std::string> defined;
    std::vector<const TiXmlElement*> named;  // in visuals
    const auto look = [&](const TiXmlElement& material, bool in_visual) {
      const char* name = material.Attribute("name");
      const TiXmlElement* color = material.FirstChildElement("color");
      const bool says = color != nullptr || material.FirstChildElement("texture") != nullptr;
      if (says && name != nullptr) defined.insert(name);
      if (!says && in_visual) named.push_back(&material);
      const char* rgba = color == nullptr ? nullptr : color->Attribute("rgba");
      if (color != nullptr && !is_color(rgba == nullptr ? "" : rgba))
        count("colours whose `rgba` is not four numbers", color->Row());
    };
    for (const TiXmlElement* e = root.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (e->ValueStr() == "material") look(*e, false);
      if (e->ValueStr() != "link") continue;
      for (const TiXmlElement* v = e->FirstChildElement("visual"); v != nullptr; v = v->NextSiblingElement("visual"))
        if (const TiXmlElement* material = v->FirstChildElement("material")) look(*material, true);
    }
    for (const TiXmlElement* material : named) {
      const char* name = material->Attribute("name");
      if (name == nullptr || defined.count(name) == 0) count("materials that nothing defines", material->Row());
    }
  }

  static bool is_color(const std::string& rgba) {
    std::istringstream stream(rgba);
    stream.imbue(std::locale::classic());
    int numbers = 0;
    for (double number = 0.0; stream >> number;) ++numbers;
    return numbers == 4 && stream.eof();
  }

  static std::string element(const std::string& name) { return "elements `" + name + "`"; }

  // The element of the longest name that the message quotes.
  const TiXmlElement* named_in(const std::string& message) const {
    const TiXmlElement* best = nullptr;
    std::size_t longest = 0;
    for (const auto* names : {&joints_, &links_}) {
      for (const auto& [name, found] : *names) {
        const bool quoted =
            message.find("'" + name + "'") != std::string::npos || message.find("[" + name + "]") != std::string::npos;
        if (!quoted || name.size() < longest) continue;
        best = found;
        longest = name.size();
      }
    }
    return best;
  }

  static int row_of(const std::map<std::string, const TiXmlElement*>& names, const std::string& name) {
    const auto found = names.find(name);
    return found == names.end() ? 0 : found->second->Row();
  }

  template <typename Parts>
  std::vector<adf::urdf::Shape> shapes_of(const Parts& parts, const std::string& link, const char* kind) const {
    std::vector<adf::urdf::Shape> shapes;
    const auto owner = links_.find(link);
    const TiXmlElement* e = owner == links_.end() ? nullptr : owner->second->FirstChildElement(kind);
    for (const auto& part : parts) {
      shapes.push_back(shape_of(*part));
      if (e == nullptr) continue;
      shapes.back().line = e->Row();
      e = e->NextSiblingElement(kind);
    }
    return shapes;
  }

  void convert(const urdf::ModelInterface& model) {
    robot_.name = model.getName();
    robot_.root = model.getRoot()->name;
    for (const auto& [name, from] : model.links_) {
      adf::urdf::Link link;
      link.name = name;
      link.line = row_of(links_, name);
      if (from->inertial != nullptr) {
        const urdf::Inertial& i = *from->inertial;
        link.has_inertial = true;
        link.mass = i.mass;
        link.inertial = pose_of(i.origin);
        link.inertia = {i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz};
      }
      link.visuals = shapes_of(from->visual_array, name, "visual");
      link.collisions = shapes_of(from->collision_array, name, "collision");
      for (std::size_t k = 0; k < link.visuals.size(); ++k) {
        const urdf::MaterialSharedPtr& material = from->visual_array[k]->material;
        if (material == nullptr) continue;
        adf::urdf::Shape& shape = link.visuals[k];
        shape.colored = true;
        shape.rgba = {material->color.r, material->color.g, material->color.b, material->color.a};
        shape.texture = material->texture_filename;
      }
      robot_.links.push_back(std::move(link));
    }
    for (const auto& [name, from] : model.joints_) robot_.joints.push_back(joint_of(name, *from));
  }

  adf::urdf::Joint joint_of(const std::string& name, const urdf::Joint& from) const {
    adf::urdf::Joint joint;
    joint.name = name;
    joint.line = row_of(joints_, name);
    joint.parent = from.parent_link_name;
    joint.child = from.child_link_name;
    joint.origin = pose_of(from.parent_to_joint_origin_transform);
    joint.axis = vector_of(from.axis);
    switch (from.type) {
      case urdf::Joint::REVOLUTE: joint.kind = JointKind::revolute; break;
      case urdf::Joint::CONTINUOUS: joint.kind = JointKind::continuous; break;
      case urdf::Joint::PRISMATIC: joint.kind = JointKind::prismatic; break;
      case urdf::Joint::FLOATING: joint.kind = JointKind::floating; break;
      case urdf::Joint::PLANAR: joint.kind = JointKind::planar; break;
      case urdf::Joint::FIXED: joint.kind = JointKind::fixed; break;
      default: break;
    }
    if (from.limits != nullptr) {
      joint.has_limits = true;
      joint.lower = from.limits->lower;
      joint.upper = from.limits->upper;
      joint.effort = from.limits->effort;
    }
    if (from.dynamics != nullptr) joint.damping = from.dynamics->damping;
    if (from.mimic != nullptr) {
      joint.has_mimic = true;
      joint.mimic_joint = from.mimic->joint_name;
      joint.mimic_multiplier = from.mimic->multiplier;
      joint.mimic_offset = from.mimic->offset;
    }
    return joint;
  }

  const std::string text_;
  Robot robot_;
  std::map<std::string, const TiXmlElement*> links_, joints_;
};

}  // namespace

Robot read_urdf(const std::string& text) { return UrdfReader(text).read(); }

}  // namespace ambf::file_reader
