#include "devices/drivers/detail/gamepad_node.h"

#include <fcntl.h>
#include <linux/joystick.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace ambf::devices {

namespace {

template <std::size_t kCodes>
class CodeBits {
 public:
  bool ask(int fd, unsigned long request) { return ioctl(fd, request, bits_.data()) >= 0; }
  bool has(unsigned code) const { return (bits_[code / 8] >> (code % 8) & 1) != 0; }
  static constexpr std::size_t kBytes = kCodes / 8 + 1;

 private:
  std::array<std::uint8_t, kBytes> bits_{};
};
using AxisBits = CodeBits<ABS_CNT>;
using ButtonBits = CodeBits<KEY_CNT>;

// joydev's order: joysticks' and gamepads' buttons first, then the miscellaneous ones before them.
template <class Use>
void for_each_button(const Use& use) {
  for (unsigned code = BTN_JOYSTICK; code < KEY_CNT; ++code) use(code);
  for (unsigned code = BTN_MISC; code < BTN_JOYSTICK; ++code) use(code);
}

bool named_joydev(const std::string& path) {
  return path.compare(path.find_last_of('/') + 1, 2, "js") == 0 ||
         (path.find("-joystick") != std::string::npos && path.find("-event-") == std::string::npos);
}

}  // namespace

std::string GamepadNode::open(const std::string& path, Format format, const Assumed& assumed, bool alone) {
  close();
  fd_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) return std::strerror(errno);
  if (alone && flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    close();
    return kInUse;
  }
  axes_ = buttons_ = 0;
  filled_ = 0;
  dropped_ = false;
  coming_ = shown_ = {};
  axis_of_code_.fill(kAbsent);
  button_of_code_.fill(kAbsent);
  format_ = format != Format::by_name ? format : named_joydev(path) ? Format::joydev : Format::evdev;
  gamepad_ = asked_ = format_ == Format::joydev ? ask_joydev() : ask_evdev();
  if (!asked_) assume(assumed);
  if (asked_ && format_ == Format::evdev) {
    gamepad_ = axis_of_code_[ABS_X] != kAbsent &&
               (button_of_code_[BTN_JOYSTICK] != kAbsent || button_of_code_[BTN_GAMEPAD] != kAbsent);
    read_state_again();
  }
  return {};
}

void GamepadNode::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

bool GamepadNode::ask_evdev() {
  AxisBits axes;
  ButtonBits buttons;
  if (!axes.ask(fd_, EVIOCGBIT(EV_ABS, AxisBits::kBytes))) return false;
  if (!buttons.ask(fd_, EVIOCGBIT(EV_KEY, ButtonBits::kBytes))) return false;
  for (unsigned code = 0; code < ABS_MISC; ++code) {
    input_absinfo info{};
    if (axes.has(code) && ioctl(fd_, EVIOCGABS(code), &info) >= 0) {
      add_axis(code, {static_cast<double>(info.minimum), static_cast<double>(info.maximum)});
    }
  }
  for_each_button([&](unsigned code) {
    if (buttons.has(code)) add_button(code);
  });
  return true;
}

bool GamepadNode::ask_joydev() {
  std::uint8_t axes = 0, buttons = 0;
  if (ioctl(fd_, JSIOCGAXES, &axes) < 0 || ioctl(fd_, JSIOCGBUTTONS, &buttons) < 0) return false;
  axes_ = std::min<unsigned>(axes, kMaxAxes);
  buttons_ = std::min<unsigned>(buttons, kMaxButtons);
  range_.fill({});
  return true;
}

void GamepadNode::assume(const Assumed& assumed) {
  axes_ = buttons_ = 0;
  range_.fill({});
  if (format_ == Format::joydev) {
    axes_ = std::min(assumed.axes, kMaxAxes);
    buttons_ = std::min(assumed.buttons, kMaxButtons);
    return;
  }
  // As the kernel's drivers of common gamepads have them.
  constexpr unsigned kAxes[] = {ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ, ABS_HAT0X, ABS_HAT0Y};
  constexpr unsigned kButtons[] = {BTN_SOUTH,  BTN_EAST,  BTN_NORTH, BTN_WEST,   BTN_TL,    BTN_TR,
                                   BTN_SELECT, BTN_START, BTN_MODE,  BTN_THUMBL, BTN_THUMBR};
  for (const unsigned code : kAxes) {
    if (axes_ == assumed.axes) break;
    const bool trigger = code == ABS_Z || code == ABS_RZ, hat = code >= ABS_HAT0X;
    const Range stick{-assumed.stick_range, assumed.stick_range};
    add_axis(code, trigger ? Range{0.0, assumed.trigger_range} : hat ? Range{-1.0, 1.0} : stick);
  }
  for (const unsigned code : kButtons) {
    if (buttons_ == assumed.buttons) break;
    add_button(code);
  }
}

void GamepadNode::add_axis(unsigned code, const Range& range) {
  if (axes_ == kMaxAxes || range.max <= range.min) return;
  axis_of_code_[code] = static_cast<std::int8_t>(axes_);
  axis_code_[axes_] = static_cast<std::uint16_t>(code);
  range_[axes_++] = range;
}

void GamepadNode::add_button(unsigned code) {
  if (buttons_ == kMaxButtons) return;
  button_of_code_[code] = static_cast<std::int8_t>(buttons_);
  button_code_[buttons_++] = static_cast<std::uint16_t>(code);
}

// At the start, and when the kernel's buffer ran over and events are missing: else a stick that was let go meanwhile
// would go on moving the tool.
void GamepadNode::read_state_again() {
  if (!asked_) return;
  for (unsigned i = 0; i < axes_; ++i) {
    input_absinfo info{};
    if (ioctl(fd_, EVIOCGABS(axis_code_[i]), &info) >= 0) set_axis(i, info.value);
  }
  ButtonBits down;
  if (down.ask(fd_, EVIOCGKEY(ButtonBits::kBytes))) {
    for (unsigned i = 0; i < buttons_; ++i) set_button(i, down.has(button_code_[i]));
  }
  shown_ = coming_;
}

bool GamepadNode::update() {
  const std::size_t size = format_ == Format::joydev ? sizeof(js_event) : sizeof(input_event);
  for (;;) {
    const ssize_t got = ::read(fd_, bytes_.data() + filled_, bytes_.size() - filled_);
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    if (got == 0) {
      // A FIFO without a writer: gone only when there was one.
      pollfd asked{fd_, POLLIN, 0};
      return poll(&asked, 1, 0) >= 0 && (asked.revents & (POLLHUP | POLLERR | POLLNVAL)) == 0;
    }
    filled_ += static_cast<std::size_t>(got);
    std::size_t used = 0;
    for (; filled_ - used >= size; used += size) obey(bytes_.data() + used);
    std::memmove(bytes_.data(), bytes_.data() + used, filled_ - used);
    filled_ -= used;
  }
}

void GamepadNode::obey(const std::uint8_t* record) {
  if (format_ == Format::joydev) {
    js_event event;
    std::memcpy(&event, record, sizeof(event));
    const int kind = event.type & ~JS_EVENT_INIT;
    if (kind == JS_EVENT_AXIS && event.number < axes_) set_axis(event.number, event.value);
    if (kind == JS_EVENT_BUTTON && event.number < buttons_) set_button(event.number, event.value != 0);
    shown_ = coming_;
    return;
  }
  input_event event;
  std::memcpy(&event, record, sizeof(event));
  obey_evdev(event);
}

void GamepadNode::obey_evdev(const input_event& event) {
  if (event.type == EV_SYN && event.code == SYN_DROPPED) {
    dropped_ = true;
  } else if (event.type == EV_SYN && event.code == SYN_REPORT) {
    if (dropped_) read_state_again();
    dropped_ = false;
    shown_ = coming_;
  } else if (dropped_) {
    return;  // half of what belongs together
  } else if (event.type == EV_ABS && event.code < ABS_CNT && axis_of_code_[event.code] != kAbsent) {
    set_axis(static_cast<unsigned>(axis_of_code_[event.code]), event.value);
  } else if (event.type == EV_KEY && event.code < KEY_CNT && button_of_code_[event.code] != kAbsent) {
    set_button(static_cast<unsigned>(button_of_code_[event.code]), event.value != 0);
  }
}

void GamepadNode::set_axis(unsigned number, double value) {
  const Range& range = range_[number];
  coming_.value[number] = (std::clamp(value, range.min, range.max) - range.min) / (range.max - range.min);
  coming_.seen |= std::uint64_t{1} << number;
}

void GamepadNode::set_button(unsigned number, bool down) {
  const std::uint64_t bit = std::uint64_t{1} << number;
  coming_.held = down ? coming_.held | bit : coming_.held & ~bit;
}

double GamepadNode::axis(unsigned number) const {
  if (number >= axes_ || (shown_.seen >> number & 1) == 0) return 0.0;
  return 2.0 * shown_.value[number] - 1.0;
}

double GamepadNode::pressed(unsigned number) const { return number < axes_ ? shown_.value[number] : 0.0; }

}  // namespace ambf::devices
