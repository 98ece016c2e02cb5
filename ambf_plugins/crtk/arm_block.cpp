// Arms in structures, frames and ADF text.
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "crtk/arm_kind.h"
#include "scene/block_kinds.h"

namespace ambf::crtk {
namespace {

using scene::Key;
using scene::KeyType;

constexpr double kMaxValue = 1e6;  // m, rad, per s: more is a mistake

constexpr Key kKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .member = scene::to<&ArmBlock::parent>(),
     .meaning = "Body that its joints hang on.",
     .required = true},
    {.name = "arm", .type = KeyType::text, .member = scene::to<&ArmBlock::arm>(), .meaning = "Name of the arm."},
    {.name = "axes",
     .type = KeyType::texts,
     .member = scene::to<&ArmBlock::axes>(),
     .meaning = "Limits: lower upper max_velocity max_acceleration turns|slides|jaw."},
    {.name = "moved joints",
     .type = KeyType::texts,
     .member = scene::to<&ArmBlock::joints>(),
     .meaning = "Joints: axis ratio offset joint|half name."},
};
constexpr const scene::Group* kIncludes[] = {&scene::group::kIdentity};
const scene::Group kArm{.title = "arm",
                        .meaning = "Set-points of an arm, written by the program for --crtk.",
                        .keys = kKeys,
                        .includes = kIncludes,
                        .is_block = true};

std::vector<scene::BlockFinding> check(const void* description) {
  ArmInfo info;
  std::vector<std::string> names;
  if (read_block(*static_cast<const ArmBlock*>(description), info, names)) return {};
  return {{.key = "axes",
           .message = "axes and joints are not of the form that the program writes",
           .hint = "arms are described in files for --crtk (docs/crtk.md)"}};
}

const scene::BlockKind kArms{.group = &kArm,
                             .list = {.name = "arms", .type = KeyType::texts, .meaning = "Arm blocks."},
                             .prefix = "ARM ",
                             .simulated = true,
                             .make = scene::make_description<ArmBlock>,
                             .check = check};

bool fits(double value) { return std::abs(value) <= kMaxValue; }

bool read_axis(const std::string& text, AxisLimits& axis, std::string& how) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  in >> axis.lower >> axis.upper >> axis.max_velocity >> axis.max_acceleration >> how;
  axis.prismatic = how == "slides";
  return !in.fail() && fits(axis.lower) && fits(axis.upper) && axis.lower <= axis.upper && fits(axis.max_velocity) &&
         axis.max_velocity > 0.0 && fits(axis.max_acceleration) && axis.max_acceleration > 0.0;
}

bool read_joint(const std::string& text, std::size_t axes, MovedJoint& joint, std::string& name) {
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  std::string how;
  in >> joint.axis >> joint.ratio >> joint.offset >> how >> std::ws;
  joint.half_of_jaw = how == "half";
  const bool good = !in.fail() && joint.axis < axes && fits(joint.ratio) && joint.ratio != 0.0 && fits(joint.offset) &&
                    (how == "half" || how == "joint");
  std::getline(in, name);
  return good && !name.empty();
}

}  // namespace

bool ArmInfo::whole() const {
  return std::all_of(joints.begin(), joints.end(), [](const MovedJoint& joint) { return joint.slot != state::kNone; });
}

std::string without_blanks(std::string name) {
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
}

bool read_block(const ArmBlock& block, ArmInfo& info, std::vector<std::string>& names) {
  info.arm = block.arm;
  info.limits = {};
  info.joints.clear(), names.clear();
  if (block.axes.empty() || block.axes.size() > kMaxAxes || block.joints.size() > 2 * kMaxAxes) return false;
  for (std::size_t i = 0; i < block.axes.size(); ++i) {
    std::string how;
    if (!read_axis(block.axes[i], info.limits.axes[i], how)) return false;
    if (how == "jaw") {
      if (i + 1 != block.axes.size()) return false;
      info.limits.has_jaw = true;
    } else if (how == "turns" || how == "slides") {
      info.limits.joints = i + 1;
    } else {
      return false;
    }
  }
  if (info.limits.joints == 0 || info.limits.joints > kMaxJoints) return false;
  for (const std::string& text : block.joints) {
    MovedJoint joint;
    std::string name;
    if (!read_joint(text, info.limits.joints, joint, name) || (joint.half_of_jaw && !info.limits.has_jaw)) return false;
    info.joints.push_back(joint);
    names.push_back(without_blanks(name));
  }
  return true;
}

const state::PlacedKind<ArmState>& arm_kind() {
  static const auto registered = state::register_placed_kind<ArmInfo, ArmState>({"arm", "arm", "arms"});
  return registered;
}

const scene::BlockKind& arm_blocks() {
  static const bool once = [] {
    scene::register_block_kind(kArms);
    return true;
  }();
  (void)once;
  return kArms;
}

}  // namespace ambf::crtk
