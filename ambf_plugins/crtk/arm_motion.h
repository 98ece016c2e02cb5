// How the set-points of one arm move, step by step in simulated time. Part of the simulated world: the same orders in
// the same steps give the same set-points, to the bit. Plain data and functions over it, any thread; nothing allocates.
// C++17.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ambf::crtk {

inline constexpr std::size_t kMaxJoints = 16;
inline constexpr std::size_t kMaxAxes = kMaxJoints + 1;  // the jaw's opening is the last
using Axes = std::array<double, kMaxAxes>;               // by joint of the kinematics, then the jaw; m or rad

enum class Mode : std::uint8_t {
  off,       // exerts nothing
  rest,      // keeps the position in which the order finds it
  hold,      // keeps the set-point that the order finds
  position,  // the set-point is this, at once
  move,      // it goes there within the limits of speed and acceleration, and rests there
  velocity,  // it goes on at this speed, up to the limits of the joints
  effort     // Nm, N; axes without a bit in ArmCommand::efforts keep a position meanwhile
};

struct Order {
  std::uint64_t number = 0;  // greater than those before it: it is new, and is obeyed once
  Mode mode = Mode::off;
};

// In a note: should joints go, the others are kept where they are, for the arm gets new ones. Else it lets go.
inline constexpr std::uint32_t kKeepsOthers = 1u << 31;

// All that an arm shall do: the newest one counts.
struct ArmCommand {
  Order arm, jaw;
  Axes values{};
  std::uint32_t efforts = ~0u;                            // bits by axis, in Mode::effort
  double ratio_velocity = 1.0, ratio_acceleration = 1.0;  // of the limits
  std::uint32_t note = 0;  // what its sender wants to find again in frames and after a snapshot; and kKeepsOthers
};

// Joints, or the jaw.
struct GroupMotion {
  Order order;           // the last one
  bool moves = false;    // a move that has not ended
  bool reached = false;  // whether the last move got to its goal
  double settling_s = 0.0;
};

struct ArmMotion {
  GroupMotion arm, jaw;
  Axes position{}, velocity{};  // set-points
  Axes goal{};                  // of positions
  Axes effort{};                // commanded
  std::uint32_t efforts = 0;
  double ratio_velocity = 1.0, ratio_acceleration = 1.0;
  std::uint32_t note = 0;
};

struct AxisLimits {
  double lower = 0.0, upper = 0.0, max_velocity = 1.0, max_acceleration = 1.0;
  bool prismatic = false;
};

struct ArmLimits {
  std::size_t joints = 0;
  bool has_jaw = false;
  std::array<AxisLimits, kMaxAxes> axes;
};

// Obeys what is new in the command. `measured`: positions of the axes.
void obey(ArmMotion& motion, const ArmLimits& limits, const ArmCommand& command, const Axes& measured);

// One step of h_s seconds; moves end here.
void advance(ArmMotion& motion, const ArmLimits& limits, const Axes& measured, double h_s);

// Every move ends, not reached; set-points that hold positions are those measured. After a reset of the world.
void start_afresh(ArmMotion& motion, const ArmLimits& limits, const Axes& measured);

// Whether a joint of it, or the jaw, exerts a commanded effort now.
bool exerts(const ArmMotion& motion, const ArmLimits& limits, std::size_t axis);

}  // namespace ambf::crtk
