#include <algorithm>
#include <set>

#include "adf/adf.h"
#include "adf/crtk/mount.h"
#include "adf/detail/crtk_instruments.h"
#include "adf/detail/files.h"

namespace ambf::adf {

namespace {

constexpr const char* kKey = "instruments";

class InstrumentReader {
 public:
  InstrumentReader(const std::string& folder, CrtkArm& arm, Report& report)
      : folder_(folder), arm_(arm), report_(report) {}

  bool read(const Value& map) {
    if (!map.is_map()) {
      return fail(map, "expected a map from tools to files, found " + describe(map), "{TOOL: file}: docs/crtk.md");
    }
    for (std::size_t i = 0; i < map.size(); ++i) {
      const auto [key, value] = map.entry(i);
      if (!read(key, value)) return false;
    }
    return true;
  }

 private:
  bool fail(const Value& at, const std::string& message, const std::string& hint) {
    report_.error(at.mark(), kKey, message, hint);
    return false;
  }

  bool read(const Value& key, const Value& value) {
    CrtkInstrument made;
    made.tool = key.is_scalar() ? key.text() : std::string();
    std::vector<std::string> tools;
    for (const kinematics::Arm& each : arm_.tools) tools.push_back(each.tool);
    if (std::find(tools.begin(), tools.end(), made.tool) == tools.end()) {
      const std::string near = report_.nearest(made.tool, tools);
      return fail(key, in_quotes(arm_.kinematics.name) + " has no tool " + in_quotes(made.tool),
                  near.empty() ? "docs/kinematics.md lists its tools" : "did you mean " + in_quotes(near) + "?");
    }
    if (!value.is_scalar()) return fail(value, "expected a file, found " + describe(value), "docs/crtk.md");
    made.file = resolve(folder_, value.text());
    const FileText file = read_text(made.file);
    if (!file.text) {
      return fail(value, "cannot read " + shown_path(value.text()) + ": " + file.problem, "is the path right?");
    }
    Options options;
    options.look_for_files = false;
    const ModelResult result = parse_model(*file.text, made.file, options);
    if (!result.model) {
      return fail(value, base::to_string(result.diagnostics.front()), "it must be an ADF file of the tool's bodies");
    }
    return parts(value, *result.model, made);
  }

  // An instrument brings the last of the arm's joints, and the first of them joins it to the arm's model.
  bool parts(const Value& value, const scene::Model& model, CrtkInstrument& made) {
    std::set<std::string> joints;
    for (const std::string& name : moved_joints(arm_.kinematics)) {
      const scene::Joint* joint = find_joint(model, name);
      if (joint == nullptr) continue;
      if (joints.empty()) made.carrier = carrier_of(model, *joint);
      joints.insert(name);
    }
    if (made.carrier.empty()) {
      return fail(value,
                  joints.empty() ? "the file has none of the arm's joints"
                                 : "the first of the arm's joints in the file hangs on a body of the file",
                  "its first joint's parent is a body of the arm's model, as in ambf_models/instruments");
    }
    if (!joints_.empty() && joints != joints_) {
      return fail(value, "the file has other joints of the arm than the first instrument has",
                  "each instrument brings the same joints");
    }
    joints_ = joints;
    made.joints.assign(joints.begin(), joints.end());
    for (const scene::Body& body : model.bodies) made.bodies.push_back(body.identity.identifier);
    arm_.instruments.push_back(std::move(made));
    return true;
  }

  const std::string& folder_;
  CrtkArm& arm_;
  Report& report_;
  std::set<std::string> joints_;
};

}  // namespace

bool read_instruments(const Value& arm_map, const std::string& folder, CrtkArm& arm, Report& report) {
  const auto map = arm_map.find(kKey);
  return !map || InstrumentReader(folder, arm, report).read(*map);
}

}  // namespace ambf::adf
