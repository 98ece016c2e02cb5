// Values of kinematics for test_both_languages.py. Each line of standard input is
//   forward|spatial|body ARM TOOL q..      or      inverse ARM TOOL x y z qx qy qz qw seed..
// (TOOL - : none), each line of output its numbers; of an inverse: status joint excess distance angle joints...
#include <cstdio>
#include <iostream>
#include <sstream>

#include "adf/arms.h"

namespace {

using ambf::kinematics::Answer;
using ambf::kinematics::Arm;
using ambf::kinematics::JacobianFrame;
using ambf::kinematics::Joints;

void print(const std::vector<double>& values) {
  for (double value : values) std::printf("%.17g ", value);
  std::printf("\n");
}

void answer(const std::string& what, const Arm& arm, const std::vector<double>& given) {
  if (what == "forward") {
    const auto pose = ambf::kinematics::forward(arm, given);
    const auto& [p, q] = pose;
    return print({p.x, p.y, p.z, q.x, q.y, q.z, q.w});
  }
  if (what != "inverse") {
    return print(jacobian(arm, given, what == "body" ? JacobianFrame::body : JacobianFrame::spatial));
  }
  const ambf::math::Pose pose{{given[0], given[1], given[2]}, {given[3], given[4], given[5], given[6]}};
  const Answer found = inverse(arm, pose, Joints(given.begin() + 7, given.end()));
  std::printf("%s %d ", to_string(found.status), found.joint);
  std::vector<double> values{found.excess, found.distance, found.angle};
  values.insert(values.end(), found.joints.begin(), found.joints.end());
  print(values);
}

}  // namespace

int main() {
  std::string line;
  while (std::getline(std::cin, line)) {
    std::istringstream words(line);
    std::string what, name, tool;
    words >> what >> name >> tool;
    std::vector<double> given;
    for (double value; words >> value;) given.push_back(value);
    const Arm* arm = ambf::adf::known_arms().find(name, tool == "-" ? "" : tool);
    if (arm == nullptr || (what == "inverse" && given.size() < 7)) return 1;
    answer(what, *arm, given);
  }
  return 0;
}
