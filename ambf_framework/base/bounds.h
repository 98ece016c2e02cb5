// How large what comes from outside may be, and how much of it at once: every bound once, with its reason. What happens
// beyond is in docs/limits.md, printed from ambf_simulator/limits_page.cpp. How many of each there may be in the world
// is in limits.h. C++17.
#pragma once

#include <cstddef>

namespace ambf::base {

// Memory that a received message may take beyond its own size, in bytes: lists of short texts take several times what
// came. With this a Step request may name kMaxObjects objects.
inline constexpr std::size_t kMaxMessageExpansion = std::size_t{4} << 20;

// Levels of values within each other in an XML-RPC request: ROS's own need 4.
inline constexpr int kMaxXmlDepth = 64;

// Requests in flight at once; more are refused where they enter. Steps get half of the places, so that pausing and
// resetting stay possible however many wait.
inline constexpr std::size_t kMaxRequests = 1024;
inline constexpr std::size_t kMaxStepRequests = kMaxRequests / 2;
// World/Command messages between two iterations of the physics thread.
inline constexpr std::size_t kMaxWorldCommands = 4096;
// Entries of one command to joints: no robot has as many, a longer list is a mistake.
inline constexpr std::size_t kMaxJointCommands = 4096;

// Names and paths in requests, bytes: PATH_MAX of Linux.
inline constexpr std::size_t kMaxPath = 4096;
// States that a Step request may ask for: as many as the world has objects, but at least this many.
inline constexpr std::size_t kMinWantedStates = 1024;
// All states that one answer may hold, bytes: a thousandth of it takes 1 ms to copy.
inline constexpr std::size_t kMaxStepAnswer = std::size_t{64} << 20;

// Kept states: their number, all their bytes, and their names' bytes. A new one is refused, none is dropped silently.
// 300 cubes take 0.3 MB. A state file may be as large as all kept states together.
inline constexpr std::size_t kMaxStepRecorders = 64;      // that request every step
inline constexpr std::size_t kMaxUnpublishedSteps = 256;  // for recorders: a quarter of a second in real time
inline constexpr std::size_t kMaxSnapshots = 4096;
inline constexpr std::size_t kMaxSnapshotBytes = std::size_t{256} << 20;
inline constexpr std::size_t kMaxSnapshotName = 255;

// Positions and sizes, m. A double still resolves 0.1 nm there, collision detection's margins need more than that.
inline constexpr double kMaxLength_m = 1e6;
// Forces and torques, N and Nm: 1 GN throws any body out of the world in one step.
inline constexpr double kMaxForce = 1e9;
// Velocities that are commanded, m/s and rad/s.
inline constexpr double kMaxSpeed = 1e6;
// Stiffnesses, dampings and gains of controllers: what is above is unstable with any body of kMaxMass_kg.
inline constexpr double kMaxGain = 1e12;

// Masses of moving bodies, kg: their squares, and ratios of any two, stay far from what a double holds.
inline constexpr double kMinMass_kg = 1e-9;
inline constexpr double kMaxMass_kg = 1e9;
// Principal moments of inertia, kg m^2.
inline constexpr double kMaxInertia = 1e12;
// No body has a principal moment above the sum of the other two. Files that round, or guess, come near; what is above
// that sum by more than this factor is repaired.
inline constexpr double kMaxInertiaExcess = 10.0;

// Factors on the size of meshes and shapes.
inline constexpr double kMinScale = 1e-9;
inline constexpr double kMaxScale = 1e6;
// A moving body whose mesh is larger, m, is most likely written in another unit.
inline constexpr double kPlausibleMeshSize_m = 30.0;

// Points of a collision mesh of type POINT_CLOUD: each is a body of its own to collision detection. A step with this
// many on a floor takes a tenth of a second; with 250,000 it took six, and 19 to load.
inline constexpr std::size_t kMaxCloudPoints = 65536;

// Rates of topics, Hz.
inline constexpr double kMaxRate_hz = 1e6;
// Angles, rad: a double still resolves 1e-10 of a turn.
inline constexpr double kMaxAngle_rad = 1e6;
// Gravity, m/s^2.
inline constexpr double kMaxAcceleration = 1e6;

}  // namespace ambf::base
