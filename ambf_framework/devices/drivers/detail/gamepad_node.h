// One node of Linux's input layer that a gamepad or joystick offers: evdev (/dev/input/event*) or joydev
// (/dev/input/js*), or a FIFO that carries the same records. Axes and buttons are numbered as joydev numbers them:
// present ones in the order of their codes. open and close on any thread; update and what it shows on one, without
// allocating or waiting. C++17.
#pragma once

#include <linux/input.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace ambf::devices {

class GamepadNode {
 public:
  enum class Format { by_name, evdev, joydev };

  // What the node has where it cannot be asked (a FIFO).
  struct Assumed {
    unsigned axes = 8, buttons = 11;
    double stick_range = 32767.0, trigger_range = 255.0;  // evdev: sticks -range .. range, triggers 0 .. range
  };

  GamepadNode() = default;
  ~GamepadNode() { close(); }
  GamepadNode(const GamepadNode&) = delete;
  GamepadNode& operator=(const GamepadNode&) = delete;

  static constexpr const char* kInUse = "in use by another device";

  // Empty, or why it cannot be read. With `alone`, a node that another driver has open so is refused (kInUse).
  std::string open(const std::string& path, Format format, const Assumed& assumed, bool alone);
  void close();
  bool is_open() const { return fd_ >= 0; }
  bool looks_like_gamepad() const { return gamepad_; }  // evdev nodes are of keyboards and mice, too

  // Reads all that has arrived. False: the node is gone.
  bool update();

  unsigned axes() const { return axes_; }
  unsigned buttons() const { return buttons_; }
  double axis(unsigned number) const;     // -1 .. 1, 0 until something arrived
  double pressed(unsigned number) const;  // a trigger: 0 .. 1, 0 until something arrived
  std::uint64_t held() const { return shown_.held; }

 private:
  static constexpr unsigned kMaxAxes = 32, kMaxButtons = 64;
  static constexpr std::int8_t kAbsent = -1;
  struct Range {
    double min = -32767.0, max = 32767.0;
  };
  struct State {
    std::array<double, kMaxAxes> value{};
    std::uint64_t held = 0, seen = 0;  // bit n: button n is down; axis n has sent a value
  };

  bool ask_evdev();
  bool ask_joydev();
  void assume(const Assumed& assumed);
  void add_axis(unsigned code, const Range& range);
  void add_button(unsigned code);
  void read_state_again();
  void obey(const std::uint8_t* record);
  void obey_evdev(const input_event& event);
  void set_axis(unsigned number, double value);
  void set_button(unsigned number, bool down);

  int fd_ = -1;
  Format format_ = Format::by_name;
  bool gamepad_ = false, asked_ = false, dropped_ = false;
  unsigned axes_ = 0, buttons_ = 0;
  std::array<std::int8_t, ABS_CNT> axis_of_code_{};
  std::array<std::int8_t, KEY_CNT> button_of_code_{};
  std::array<std::uint16_t, kMaxAxes> axis_code_{};
  std::array<std::uint16_t, kMaxButtons> button_code_{};
  std::array<Range, kMaxAxes> range_{};
  State coming_, shown_;  // evdev: what belongs together is shown together, at SYN_REPORT
  std::array<std::uint8_t, 64 * sizeof(input_event)> bytes_{};
  std::size_t filled_ = 0;
};

}  // namespace ambf::devices
