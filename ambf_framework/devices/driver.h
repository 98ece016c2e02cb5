// What drives a physical input device: built in (devices/drivers/), a shared library, or a test's double. A driver
// knows its hardware alone: no scene, no mapping, no forces' meaning. SI units, radians. C++17.
//
// Frames: U, the operator's view: x towards the operator, y to the right, z up (EQUATIONS 0). A driver undoes how its
// hardware is mounted (`base` and `tip` frames of the device file): what it reads is T_IID of EQUATIONS 3, what it
// writes is in U.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "math/types.h"

namespace ambf::devices {

struct DriverTraits {
  bool orientation = true;  // it senses orientation; else samples keep the identity
  bool force = false, torque = false;
  bool gripper = false;
  unsigned buttons = 0;       // numbers 0 .. buttons - 1 have a meaning
  double rate_hz = 0.0;       // of its samples, where it has one of its own; 0: as often as it is read (-d)
  bool event_driven = false;  // sends only when something changes: silence is no fault
  bool on_demand = false;     // its user takes it in hand at will (Sample::ready): being left is no fault
  double max_force_N = 0.0, max_torque_Nm = 0.0;
  double max_stiffness_N_m = 0.0;  // at the hand
  double hold_at_start_s = 3.0;    // no motion and no force for so long after it opened
};

struct Sample {
  std::int64_t stamp_ns = 0;  // steady clock
  math::Pose T_u_tip;         // T_IID
  double jaw = 0.0;           // 0 closed .. 1 open
  bool has_jaw = false;
  std::uint64_t buttons = 0;   // bit n: button n is down
  bool ready = true;           // false: powered off, not homed, nobody holds it: it counts as clutched
  const char* not_ready = "";  // why, static text: "the operator is absent"
};

enum class Reading { sample, nothing_new, lost };

class Driver {
 public:
  virtual ~Driver() = default;
  virtual const DriverTraits& traits() const = 0;
  // Finds and opens the hardware. Empty when it did; else what it looked for and what to set, for people to read. Not
  // on the device's thread; may take its time. Again after `lost`.
  virtual std::string open() = 0;
  // The device's thread, once a period (or, event_driven, whenever it pleases): the newest sample. May wait for its own
  // hardware, at most max_wait_s; takes no lock, allocates nothing and logs nothing itself.
  virtual Reading read(Sample& sample, double max_wait_s) = 0;
  // The device's thread: wrench on the hand at the tip, in U; N, N m. The driver holds it until the next one, for at
  // most 0.1 s.
  virtual void write(const math::Wrench& wrench_u) = 0;
  // Sends a zero wrench first.
  virtual void close() = 0;
};

// What the device file says about a device's hardware (its key `driver`), as text.
struct DriverRequest {
  std::string device;  // the device's name
  std::string hardware_name;
  std::string type;                            // driver.type; empty: found by the hardware name
  std::map<std::string, std::string> options;  // other keys of `driver`: path, topics ...; nested: "axes/x"
  math::Pose T_base_offset, T_tip_offset;      // IID-BO in the base's axes, IID-TO in the tip's (EQUATIONS 3)
  std::string folder;                          // of the device file: relative paths start there
};

struct DriverKind {
  std::string type;                                                   // "gamepad", as driver.type spells it
  std::vector<std::string> hardware_names;                            // that it answers to, e.g. "MTMR"
  std::function<std::unique_ptr<Driver>(const DriverRequest&)> make;  // null: the options make no sense
};

// Before the first device is opened; not thread-safe. Throws std::logic_error when the type is taken.
void register_driver(DriverKind kind);
const std::vector<DriverKind>& driver_kinds();
// By type, else by hardware name; null: none (why: driver_library.h). May load shared libraries that have further
// ones. Valid until the next call. Not thread-safe.
const DriverKind* find_driver(const DriverRequest& request);

// T_IID = inv(T_B_BO) T_B_E T_E_TO (EQUATIONS 3), and a wrench in U in the base's axes.
math::Pose to_user_frame(const DriverRequest& request, const math::Pose& T_base_tip);
math::Wrench to_base_axes(const DriverRequest& request, const math::Wrench& wrench_u);

}  // namespace ambf::devices
