#include "adf/crtk_arms.h"

#include <algorithm>
#include <cmath>

#include "adf/arms.h"
#include "adf/detail/crtk_instruments.h"
#include "adf/detail/files.h"
#include "adf/detail/scalars.h"
#include "adf/document.h"
#include "adf/report.h"
#include "math/rotation.h"

namespace ambf::adf {

namespace {

constexpr double kQuarterTurn = 1.5707963267948966;  // rad/s, rad/s^2: usual limits of what turns
constexpr double kSlide = 0.2;                       // m/s, m/s^2: of what slides
constexpr double kMaxRateHz = 1000.0;
constexpr const char* kSeeDocs = "docs/crtk.md lists the keys of an arm";

const std::vector<std::string>& keys() {
  static const std::vector<std::string> all = {
      "kinematics", "kinematics file",  "tool", "base",    "joints", "frame",  "base frame",  "rate",  "max velocity",
      "homing",     "max acceleration", "jaw",  "gripper", "view",   "brakes", "instruments", "camera"};
  return all;
}

// Of one part or several: SUJ/PSM1.
bool is_ros_name(const std::string& name) {
  bool begins = true;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (begins ? std::isalpha(byte) == 0 : std::isalnum(byte) == 0 && c != '_' && c != '/') return false;
    begins = c == '/';
  }
  return !begins;
}

class Reader {
 public:
  Reader(Report& report, std::string folder) : report_(report), folder_(std::move(folder)) {}

  bool read(const Value& map, CrtkArm& arm) {
    if (!map.is_map()) return fail(map, {}, "an arm is a map of keys, found " + describe(map), kSeeDocs);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const Value key = map.entry(i).key;
      const std::string& name = key.text();
      if (std::find(keys().begin(), keys().end(), name) != keys().end()) continue;
      const std::string near = report_.nearest(name, keys());
      report_.warning(key.mark(), name, "unknown key",
                      near.empty() ? kSeeDocs : "did you mean " + in_quotes(near) + "? It has no effect now");
    }
    return kinematics(map, arm) && base(map, arm) && frame(map, arm) && limits(map, arm) && homing(map, arm) &&
           gripper(map, arm) && read_instruments(map, folder_, arm, report_);
  }

 private:
  bool fail(const Value& at, const std::string& key, const std::string& message, const std::string& hint) {
    report_.error(at.mark(), key, message, hint);
    return false;
  }

  bool text(const Value& map, const char* key, std::string& out) {
    const auto value = map.find(key);
    if (!value) return true;
    if (!value->is_scalar()) return fail(*value, key, "expected a text, found " + describe(*value), kSeeDocs);
    out = value->text();
    return true;
  }

  bool number(const Value& value, const char* key, double& out, bool positive) {
    const auto read = value.is_scalar() ? to_number(value.text()) : std::nullopt;
    if (!read || !std::isfinite(*read) || (positive && *read <= 0.0)) {
      return fail(value, key,
                  std::string("expected a ") + (positive ? "number above 0" : "number") + ", found " + describe(value),
                  "SI units: m, rad, s");
    }
    out = *read;
    return true;
  }
  bool number_at(const Value& map, const char* key, double& out, bool positive) {
    const auto value = map.find(key);
    return !value || number(*value, key, out, positive);
  }

  // One number for each joint, or one for all.
  bool numbers(const Value& map, const char* key, std::vector<double>& out) {
    const auto value = map.find(key);
    if (!value) return true;
    if (!value->is_list() || value->size() != out.size()) {
      return fail(*value, key,
                  "expected a list of " + std::to_string(out.size()) + " numbers, one a joint, found " +
                      (value->is_list() ? std::to_string(value->size()) : describe(*value)),
                  "in the order of the kinematics' joints");
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (!number(value->item(i), key, out[i], true)) return false;
    }
    return true;
  }

  bool vector(const Value& map, const char* key, math::Vec3& out) {
    const auto value = map.find(key);
    if (!value) return true;
    if (!value->is_list() || value->size() != 3) {
      return fail(*value, key, "expected a list of three numbers, found " + describe(*value), "m, rad");
    }
    double numbers[3];
    for (std::size_t i = 0; i < 3; ++i) {
      if (!number(value->item(i), key, numbers[i], false)) return false;
    }
    out = {numbers[0], numbers[1], numbers[2]};
    return true;
  }

  bool kinematics(const Value& map, CrtkArm& arm) {
    std::string name, tool, file;
    if (!text(map, "kinematics", name) || !text(map, "tool", tool) || !text(map, "kinematics file", file)) return false;
    if (name.empty()) return fail(map, "kinematics", "the arm needs `kinematics`, the name of an arm", kSeeDocs);
    ArmTable own;
    if (!file.empty()) {
      const FileText read = read_text(resolve(folder_, file));
      const Value at = *map.find("kinematics file");
      if (!read.text) return fail(at, "kinematics file", "cannot read " + shown_path(file), "is the path right?");
      ArmsResult result = parse_arms(*read.text, resolve(folder_, file));
      for (const base::Diagnostic& found : result.diagnostics) {
        report_.add(found.severity, at.mark(), "kinematics file", base::to_string(found));
      }
      own = std::move(result.table);
    }
    const ArmTable& table = file.empty() ? known_arms() : own;
    const Value at = *map.find("kinematics");
    if (table.find(name) == nullptr) {
      const std::string near = report_.nearest(name, table.names);
      return fail(at, "kinematics", "there is no arm " + in_quotes(name),
                  near.empty() ? "docs/kinematics.md lists the arms" : "did you mean " + in_quotes(near) + "?");
    }
    const kinematics::Arm* found = table.find(name, tool);
    if (found == nullptr) {
      std::vector<std::string> tools;
      for (const kinematics::Arm& each : table.arms) {
        if (each.name == name) tools.push_back(each.tool);
      }
      const std::string near = report_.nearest(tool, tools);
      return fail(*map.find("tool"), "tool", in_quotes(name) + " has no tool " + in_quotes(tool),
                  near.empty() ? "docs/kinematics.md lists its tools" : "did you mean " + in_quotes(near) + "?");
    }
    arm.kinematics = *found;
    arm.kinematics_line = at.mark().line, arm.kinematics_column = at.mark().column;
    if (!joints(map, arm.kinematics)) return false;
    for (const kinematics::Arm& each : table.arms) {
      const bool fits =
          each.name == name && each.size() == found->size() && each.jaw.has_value() == found->jaw.has_value();
      if (!fits) continue;
      arm.tools.push_back(each);
      arm.tools.back().adf_joints = arm.kinematics.adf_joints;
      arm.tools.back().adf_jaw = arm.kinematics.adf_jaw;
    }
    return true;
  }

  // Names of the model's joints, where they are not those of the table.
  bool joints(const Value& map, kinematics::Arm& arm) {
    const auto list = map.find("joints");
    if (list) {
      const std::size_t expected = arm.size() - (arm.adf_jaw.empty() ? 0 : 1);
      if (!list->is_list() || list->size() != expected) {
        return fail(*list, "joints", "expected a list of " + std::to_string(expected) + " names of joints",
                    "in the order of the kinematics' joints; a wrist that two halves of a jaw carry has none");
      }
      arm.adf_joints.resize(expected);
      for (std::size_t i = 0; i < expected; ++i) {
        if (!list->item(i).is_scalar()) return fail(list->item(i), "joints", "expected a name", kSeeDocs);
        arm.adf_joints[i].name = list->item(i).text();
      }
    }
    if (arm.adf_joints.size() + (arm.adf_jaw.empty() ? 0 : 1) != arm.size()) {
      return fail(map, "joints", "the kinematics " + in_quotes(arm.name) + " names no joints of a model",
                  "list them in `joints`");
    }
    return true;
  }

  bool base(const Value& map, CrtkArm& arm) {
    const auto value = map.find("base");
    if (!value || !value->is_scalar()) {
      return fail(map, "base", "the arm needs `base`, a body of the scene",
                  "its whole name, such as /ambf/env/psm/BODY base link");
    }
    arm.base = value->text();
    arm.base_line = value->mark().line, arm.base_column = value->mark().column;
    return true;
  }

  bool frame(const Value& map, CrtkArm& arm) {
    arm.frame = arm.name + "_base";
    if (!text(map, "frame", arm.frame)) return false;
    if (!text(map, "view", arm.view)) return false;
    if (arm.view == arm.name) return fail(*map.find("view"), "view", "an arm is not in its own view", kSeeDocs);
    if (!text(map, "camera", arm.camera)) return false;
    if (!arm.camera.empty() && !arm.is_endoscope()) {
      return fail(*map.find("camera"), "camera", in_quotes(arm.kinematics.name) + " is no endoscope's arm",
                  "its kinematics have the tools STRAIGHT, UP and DOWN");
    }
    const auto pose = map.find("base frame");
    if (!pose) return true;
    math::Vec3 rpy{};
    if (!pose->is_map()) return fail(*pose, "base frame", "expected {xyz: [...], rpy: [...]}", "m, rad");
    if (!vector(*pose, "xyz", arm.T_frame_base.position) || !vector(*pose, "rpy", rpy)) return false;
    arm.T_frame_base.orientation = math::from_rpy(rpy.x, rpy.y, rpy.z);
    return true;
  }

  bool limits(const Value& map, CrtkArm& arm) {
    for (const bool slides : arm.kinematics.prismatic) {
      arm.max_velocity.push_back(slides ? kSlide : kQuarterTurn);
      arm.max_acceleration.push_back(slides ? kSlide : kQuarterTurn);
    }
    arm.jaw_max_velocity = arm.jaw_max_acceleration = 2.0 * kQuarterTurn;
    if (!numbers(map, "max velocity", arm.max_velocity) || !numbers(map, "max acceleration", arm.max_acceleration)) {
      return false;
    }
    if (!number_at(map, "rate", arm.rate_hz, true)) return false;
    if (arm.rate_hz > kMaxRateHz) return fail(*map.find("rate"), "rate", "at most 1000 Hz", "states come each ms");
    const auto jaw = map.find("jaw");
    if (!jaw) return true;
    if (!jaw->is_map() || !arm.has_jaw()) {
      return fail(*jaw, "jaw", arm.has_jaw() ? "expected a map" : "the kinematics have no driven jaw", kSeeDocs);
    }
    return number_at(*jaw, "max velocity", arm.jaw_max_velocity, true) &&
           number_at(*jaw, "max acceleration", arm.jaw_max_acceleration, true);
  }

  bool homing(const Value& map, CrtkArm& arm) {
    std::string word = "move";
    if (!text(map, "homing", word)) return false;
    if (word != "move" && word != "none") {
      return fail(*map.find("homing"), "homing", "expected move or none, found " + in_quotes(word),
                  "none: the arm is homed from the start");
    }
    arm.homing_moves = word == "move";
    const auto brakes = map.find("brakes");
    if (!brakes) return true;
    const auto given = brakes->is_scalar() ? to_boolean(brakes->text()) : std::nullopt;
    if (!given) return fail(*brakes, "brakes", "expected true or false, found " + describe(*brakes), kSeeDocs);
    arm.brakes = *given;
    return true;
  }

  bool gripper(const Value& map, CrtkArm& arm) {
    const auto value = map.find("gripper");
    if (!value) return true;
    arm.gripper.emplace();
    if (!value->is_map() || !text(*value, "joint", arm.gripper->joint) || arm.gripper->joint.empty()) {
      return fail(*value, "gripper", "expected {joint: NAME}, a joint of the model", kSeeDocs);
    }
    return number_at(*value, "scale", arm.gripper->scale, false) &&
           number_at(*value, "offset", arm.gripper->offset, false) &&
           number_at(*value, "closed below", arm.gripper->closed_below, false);
  }

  Report& report_;
  const std::string folder_;
};

}  // namespace

bool CrtkArm::is_endoscope() const {
  const auto has = [this](const char* tool) {
    return std::any_of(tools.begin(), tools.end(), [&](const kinematics::Arm& each) { return each.tool == tool; });
  };
  return has("STRAIGHT") && has("UP") && has("DOWN");
}

CrtkArmsResult parse_crtk_arms(const std::string& text, const std::string& path) {
  CrtkArmsResult result;
  Report report(path);
  const Document document(text);
  if (document.error()) {
    report.error(document.error()->mark, {}, document.error()->message, document.error()->hint);
    result.diagnostics = report.take();
    return result;
  }
  const Value root = document.root();
  const auto arms = root.is_map() ? root.find("crtk arms") : std::nullopt;
  if (!arms || !arms->is_map()) {
    report.error(arms ? arms->mark() : root.mark(), "crtk arms", "expected a map of arms below `crtk arms`", kSeeDocs);
    result.diagnostics = report.take();
    return result;
  }
  for (std::size_t i = 0; i < arms->size(); ++i) {
    const auto [key, own] = arms->entry(i);
    CrtkArm arm;
    arm.name = key.is_scalar() ? key.text() : std::string();
    arm.file = path;
    arm.line = key.mark().line, arm.column = key.mark().column;
    report.set_block(arm.name);
    const bool taken = std::any_of(result.arms.begin(), result.arms.end(),
                                   [&](const CrtkArm& other) { return other.name == arm.name; });
    if (!is_ros_name(arm.name) || taken) {
      report.error(key.mark(), {}, taken ? "there are two arms " + in_quotes(arm.name) : "no name for topics",
                   taken ? "give each arm its own name"
                         : "a letter, then letters, digits and '_'; parts of it are separated by '/'");
      continue;
    }
    const std::size_t slash = path.rfind('/');
    if (Reader(report, slash == std::string::npos ? std::string() : path.substr(0, slash)).read(own, arm)) {
      result.arms.push_back(std::move(arm));
    }
  }
  result.diagnostics = report.take();
  return result;
}

CrtkArmsResult load_crtk_arms(const std::string& path) {
  const FileText file = read_text(path);
  if (file.text) return parse_crtk_arms(*file.text, path);
  CrtkArmsResult result;
  Report report(path);
  report.error({}, {}, "cannot read the file: " + file.problem, "is the path right?");
  result.diagnostics = report.take();
  return result;
}

}  // namespace ambf::adf
