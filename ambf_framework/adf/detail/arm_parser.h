// Reads one arm of a file of known arms. Inside this folder.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "adf/document.h"
#include "kinematics/arm.h"

namespace ambf::adf {

// An arm while its file, the arm it is the same as, and its tool change it.
struct ArmDraft {
  kinematics::Arm arm;
  kinematics::Convention convention = kinematics::Convention::modified;
  math::Pose foot, tip;
  Value tools;
  std::string default_tool;
};

// The first mistake of an arm; the rest of it is then not read.
struct ArmMistake {
  Mark mark;
  std::string message, hint;
};

// Its functions are false after a mistake.
class ArmReader {
 public:
  explicit ArmReader(Value root) : root_(root) {}

  // `own`: the arm's map in the file. Starts from the arm that it is the same as, if any.
  bool read_arm(Value own, ArmDraft& draft, int depth = 0);
  // The keys of a map, one after the other: an arm's own, or a tool's.
  bool apply(Value changes, ArmDraft& draft);
  // Checks the whole and makes the chain.
  bool finish(Value own, ArmDraft& draft);

  const ArmMistake& mistake() const { return mistake_; }

 private:
  // Notes the mistake where `right` is false, and returns it.
  bool expect(bool right, Value where, const std::string& message, const std::string& hint = {});
  bool number(Value value, double& out, double unit = 1.0);
  bool numbers(Value value, std::vector<double>& out, std::size_t count, double unit = 1.0);
  bool apply(Value key, Value value, ArmDraft& draft);

  template <typename T>
  bool choice(Value value, T& out, const std::map<std::string, T>& words) {
    const auto found = words.find(value.is_scalar() ? value.text() : std::string());
    if (!expect(found != words.end(), value, "expected one of the words that docs/kinematics.md lists")) return false;
    out = found->second;
    return true;
  }

  bool limits(Value owner, double& lower, double& upper);
  bool joints(Value list, kinematics::Arm& arm);

  // Index of an entry of a map that changes a list.
  bool index(Value key, std::size_t size, std::size_t& out);
  bool changed_joints(const std::string& name, Value map, kinematics::Arm& arm);
  bool row(Value map, kinematics::Row& row);
  bool rows(Value value, kinematics::Arm& arm);
  bool pose(Value map, math::Pose& out);
  bool jaw(Value map, kinematics::Arm& arm);
  bool coupling(Value value, kinematics::Arm& arm);
  bool adf(Value map, kinematics::Arm& arm);

  Value root_;
  ArmMistake mistake_;
};

}  // namespace ambf::adf
