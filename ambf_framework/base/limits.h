// How many of each there may be at one time: every number once, with its reason. What happens beyond is in
// docs/limits.md. C++17.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ambf::base {

// Readers of frames: the publisher, the picture streamer, the parameter server, windows, the service threads that wait
// for steps, and a thread for each of a dozen input devices. Each costs two frames (0.27 MB with three arms), made at
// every change of the structure. One 64-bit mask of slots has room for 31 (exchange/frame_pool.h).
inline constexpr int kMaxReaders = 20;
// Two pins a reader, the newest frame, and the one that is being written.
constexpr std::size_t frames_for(int readers) { return 2 * static_cast<std::size_t>(readers) + 2; }
inline constexpr std::size_t kFramesPerPool = frames_for(kMaxReaders);

// Sources of commands and laws: those that state::Source names, and 59 input devices. One 64-bit mask of each object.
inline constexpr int kMaxSources = 64;

// Pointers that hold a body: windows' mice, and devices.
inline constexpr std::size_t kMaxPicks = 32;

// Bodies that input devices hold, one for each device on it.
inline constexpr std::size_t kMaxEffectors = 64;

// Bodies that one actuator holds at a time.
inline constexpr std::size_t kMaxHeldBodies = 16;

// Laws that hold bodies, and their shares in a frame, beyond one for each body.
inline constexpr std::size_t kSpareLaws = 256;

// Contacts in a frame: 140 kB, in which a pile of 300 cubes fits.
inline constexpr std::size_t kMaxContactsInFrame = 1024;

// What sensors and ghosts report in a frame: contacts of one contact sensor and of all (0.5 MB), overlaps of all ghosts
// (64 kB), and the last events of all judged sensors: one flickering sensor has up to six in each step.
inline constexpr std::size_t kMaxContactsOfASensor = 256, kMaxSensedContacts = 4096;
inline constexpr std::size_t kMaxGhostTouches = 16384;
inline constexpr std::size_t kMaxSensorEvents = 2048;

// How fast a command may make a body, m/s and rad/s: faster than any instrument, slow enough that a body is still
// simulated in steps of 1 ms. Forces, torques and efforts are cut to what reaches it.
inline constexpr double kMaxCommandedSpeed = 1e3;

// Moving bodies near one body before they count as a crowd, and how many new ones each body of a crowd meets at a time.
inline constexpr std::uint32_t kMaxNearBodies = 32, kNewNearBodies = 6;

// Visits of joint rows by the solver in a step of one mechanism: some 0.1 s. A robot has some hundred rows and is
// solved some ten times.
inline constexpr std::int64_t kMaxJointWork = 2'000'000;

// Objects in the world: their dirty flags are allocated at the start, for all of them.
inline constexpr std::size_t kMaxObjects = 65536;

}  // namespace ambf::base
