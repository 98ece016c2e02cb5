// What the process that reads URDF files may answer, to a scene: a stranger's bytes are refused or end in ADF text that
// is read without an error of its form. The first byte chooses: the bytes are the answer, or numbers and choices that a
// robot is made of, so that what comes after the check is reached, too.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "adf/adf.h"
#include "adf/detail/urdf_writer.h"
#include "math/rotation.h"

namespace {

using namespace ambf;
using adf::urdf::Robot;

// libFuzzer reports an abort with its input.
void require(bool good) {
  if (!good) std::abort();
}

class RobotOfBytes {
 public:
  explicit RobotOfBytes(std::string_view bytes) : rest_(bytes) {}

  Robot make() {
    Robot robot;
    robot.name = name();
    robot.root = "l0";
    const int links = 1 + byte() % 8;
    for (int i = 0; i < links; ++i) {
      adf::urdf::Link& link = robot.links.emplace_back();
      link.name = "l" + std::to_string(i);
      link.has_inertial = byte() % 2 == 1;
      link.mass = number();
      link.inertial = pose();
      for (double& moment : link.inertia) moment = number();
      shapes(link.visuals);
      shapes(link.collisions);
      if (i == 0) continue;
      adf::urdf::Joint& joint = robot.joints.emplace_back();
      joint.name = "j" + std::to_string(i);
      joint.parent = "l" + std::to_string(byte() % i);
      joint.child = link.name;
      joint.kind = static_cast<adf::urdf::JointKind>(1 + byte() % 6);
      joint.origin = pose();
      joint.axis = vector();
      joint.has_limits = byte() % 2 == 1;
      joint.has_mimic = byte() % 2 == 1;
      joint.mimic_joint = "j" + std::to_string(byte() % 8);
      for (double* value :
           {&joint.lower, &joint.upper, &joint.effort, &joint.damping, &joint.mimic_multiplier, &joint.mimic_offset})
        *value = number();
    }
    return robot;
  }

 private:
  int byte() {
    if (rest_.empty()) return 0;
    const int value = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }
  double number() {
    static constexpr double kNumbers[] = {0.0, 1.0, -1.0, 0.5, -0.25, 1e-12, 1e12, -1e300, 1e-300, 3.14159265358979};
    const auto choice = static_cast<std::size_t>(byte());
    if (choice < std::size(kNumbers) || rest_.size() < sizeof(double)) return kNumbers[choice % std::size(kNumbers)];
    double value = 0.0;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;  // perhaps not finite
  }
  math::Vec3 vector() { return {number(), number(), number()}; }
  math::Pose pose() {
    math::Pose pose{vector(), {}};
    if (byte() % 2 == 1) pose.orientation = math::normalized(math::Quat{number(), number(), number(), number()});
    return pose;
  }
  std::string name() {
    const auto length = std::min<std::size_t>(static_cast<std::size_t>(byte()), rest_.size());
    const std::string text(rest_.substr(0, length));
    rest_.remove_prefix(length);
    return text;
  }
  void shapes(std::vector<adf::urdf::Shape>& shapes) {
    for (int left = byte() % 4; left > 0; --left) {
      adf::urdf::Shape& shape = shapes.emplace_back();
      shape.kind = static_cast<adf::urdf::ShapeKind>(byte() % 6);
      shape.size = vector();
      shape.file = byte() % 2 == 1 ? "a.stl" : name();
      shape.origin = pose();
      shape.colored = byte() % 2 == 1;
      for (float& value : shape.rgba) value = static_cast<float>(byte()) / 200.0F;
    }
  }

  std::string_view rest_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  std::string answer(reinterpret_cast<const char*>(data + 2), size - 2);
  if (data[0] % 2 == 0) {
    Robot made = RobotOfBytes(answer).make();
    base::WireWriter writer;
    adf::urdf::transfer(writer, made);
    answer = std::move(writer).bytes();
  }
  Robot robot;
  base::WireReader reader(answer);
  adf::urdf::transfer(reader, robot);
  if (!reader.at_end() || !adf::urdf::check(robot).empty() || !robot.error.empty()) return 0;

  std::size_t warnings = 0;
  const adf::urdf::Warn warn = [&warnings](int, const std::string& message, const std::string&) {
    require(!message.empty());
    ++warnings;
  };
  const std::string name = robot.name;
  const adf::urdf::Plan plan = adf::urdf::plan_of(std::move(robot), {data[1] % 2 == 1, data[1] / 2 % 2 == 1}, warn);
  const adf::urdf::Written written = adf::urdf::write_adf(plan, name, {"robot.urdf", ""}, warn);
  adf::Options options;
  options.look_for_files = false;
  const adf::ModelResult result = adf::parse_model(written.adf, "robot.yaml", options);
  require(result.model.has_value() || base::has_errors(result.diagnostics));
  if (!result.model) return 0;
  // A block may be refused for its numbers, and is then named.
  require(result.model->bodies.size() == plan.bodies.size() || base::has_errors(result.diagnostics));
  for (const scene::Body& body : result.model->bodies) require(math::is_finite(body.T_world_body.position));
  return 0;
}
