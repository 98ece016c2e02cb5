// What keys, mouse and dropped files do in a window.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "base/clock.h"
#include "render/drop.h"
#include "render/font.h"
#include "render/window_viewer.h"

namespace ambf::render {

namespace {

constexpr math::Vec3 kGravity{0.0, 0.0, -9.81};

}  // namespace

void WindowViewer::handle(const Input& input) {
  if (const auto* key = std::get_if<KeyInput>(&input)) on_key(*key);
  if (const auto* button = std::get_if<ButtonInput>(&input)) on_button(*button);
  if (const auto* motion = std::get_if<MotionInput>(&input)) on_motion(*motion);
  if (const auto* wheel = std::get_if<WheelInput>(&input)) on_wheel(*wheel);
  if (const auto* drop = std::get_if<DropInput>(&input)) on_drop(*drop);
}

void WindowViewer::on_key(const KeyInput& key) {
  constexpr unsigned kTen = 10;
  switch (action_of(key.key, key.modifiers, key.held)) {
    case Action::none: break;
    case Action::quit: quit_ = true; break;
    case Action::help:
      help_ = !help_;
      if (help_) {
        for (const std::string& line : help_lines()) std::printf("%s\n", line.c_str());
        std::fflush(stdout);
      }
      break;
    case Action::pause:
      control_.set_paused(!frame_->run.paused);
      messages_->add(frame_->run.paused ? "running" : "paused");
      break;
    case Action::step_once: control_.step_paused(1); break;
    case Action::step_ten: control_.step_paused(kTen); break;
    case Action::reset_bodies:
      control_.reset_bodies();
      messages_->add("bodies reset");
      break;
    case Action::reset_world:
      control_.reset_world();
      messages_->add("world reset");
      break;
    case Action::reset_cameras:
      view_.reset_all(*frame_, base::steady_ns());
      messages_->add("cameras reset");
      break;
    case Action::gravity_on:
      control_.set_gravity(kGravity);
      messages_->add("gravity on");
      break;
    case Action::gravity_off:
      control_.set_gravity({});
      messages_->add("gravity off");
      break;
    case Action::picking:
      picking_ = !picking_;
      if (!picking_ && picker_.pressed()) picker_.release();
      messages_->add(picking_ ? "picking: the left button drags bodies" : "picking off");
      break;
    case Action::remove_picked: remove_picked(); break;
    case Action::full_screen: window_->toggle_full_screen(); break;
    case Action::all_frames: all_frames_ = !all_frames_; break;
    case Action::picked_frame:
      if (!picker_.last().valid()) {
        messages_->add("no body was picked yet");
      } else if (framed_body_ == picker_.last()) {
        framed_body_.reset();
      } else {
        framed_body_ = picker_.last();
      }
      break;
  }
}

void WindowViewer::remove_picked() {
  const std::uint32_t object = state::find(*frame_->structure, picker_.last());
  if (object == state::kNone) {
    messages_->add("no body was picked yet, or it is gone");
    return;
  }
  const std::string name = frame_->structure->objects[object].name;
  if (picker_.pressed()) picker_.release();
  control_.remove(name, [messages = messages_, &log = log_, name](const state::Outcome& outcome) {
    log.report(outcome.diagnostics);
    messages->add(outcome.success ? "removed " + name : "not removed: " + outcome.message);
  });
}

void WindowViewer::on_button(const ButtonInput& button) {
  x_ = button.x;
  y_ = button.y;
  if (!button.pressed) {
    if (button.button == MouseButton::left && picker_.pressed()) picker_.release();
    if (button.button == MouseButton::left) panning_ = false;
    if (button.button == MouseButton::middle) panning_ = rotating_ = false;
    if (button.button == MouseButton::right) looking_ = false;
    view_.rest();
    return;
  }
  switch (button.button) {
    case MouseButton::left:
      if (picking_ || button.modifiers.control) {
        const auto [width, height] = window_->size();
        if (!picker_.press(view_.camera(), width, height, x_, y_)) messages_->add("too many pointers hold something");
      } else {
        panning_ = true;
      }
      break;
    case MouseButton::middle: (button.modifiers.shift ? panning_ : rotating_) = true; break;
    case MouseButton::right: looking_ = true; break;
  }
}

void WindowViewer::on_motion(const MotionInput& motion) {
  const double right_px = motion.x - x_, down_px = motion.y - y_;
  x_ = motion.x;
  y_ = motion.y;
  const auto [width, height] = window_->size();
  if (width <= 0 || height <= 0) return;
  if (picker_.pressed()) {
    picker_.drag(view_.camera(), width, height, x_, y_);
    return;
  }
  const double slow = motion.left_shift && !rotating_ ? kSlow : 1.0;
  const std::int64_t now_ns = base::steady_ns();
  const View& view = view_.view();
  if (panning_) {
    const Camera& camera = view_.camera();
    const double scale = camera.orthographic_width_m > 0.0
                             ? camera.orthographic_width_m / width
                             : pan_scale(view, view_.pan_multiplier(), camera.field_of_view_rad, height);
    view_.move(pan(view, right_px, down_px, slow * scale), now_ns);
  } else if (looking_) {
    view_.move(look(view, right_px, down_px, slow * kLookPerPixel * view_.rotate_multiplier()), now_ns);
  } else if (rotating_) {
    view_.move(orbit(view, right_px, down_px, slow * kOrbitPerPixel * view_.arcball_multiplier()), now_ns);
  }
}

void WindowViewer::on_wheel(const WheelInput& wheel) {
  const double notches = wheel.notches * (wheel.left_shift ? kSlow : 1.0);
  if (view_.camera().orthographic_width_m > 0.0) {
    view_.widen(1.0 - 0.1 * std::clamp(notches * view_.scroll_multiplier(), -5.0, 5.0));
    return;
  }
  // The target keeps the reference's distance of half a metre, or less where the camera is made for small things.
  const double least = std::min(kLeastTargetDistance_m, 5.0 * view_.camera().near_m);
  view_.move(dolly(view_.view(), notches, view_.scroll_multiplier(), least), base::steady_ns());
}

void WindowViewer::on_drop(const DropInput& drop) {
  for (const std::string& path : drop.paths) {
    if (const std::string refusal = refusal_of_drop(path); !refusal.empty()) {
      log_.warning("%s", refusal.c_str());
      messages_->add(refusal);
      continue;
    }
    const std::string name = std::filesystem::path(path).filename().string();
    messages_->add("loading '" + name + "'");
    state::LoadRequest request;
    request.path = path;
    // Called from the loader's thread, perhaps after this window is gone.
    control_.load(std::move(request), [messages = messages_, &log = log_, name](const state::Outcome& outcome) {
      log.report(outcome.diagnostics);
      if (outcome.success) {
        log.info("%s", outcome.message.c_str());
        messages->add("loaded '" + name + "'");
      } else {
        log.error("%s", outcome.message.c_str());
        messages->add("not loaded: '" + name + "': " + outcome.message);
      }
    });
  }
}

void WindowViewer::draw_labels(FlatDrawing& marks, std::int64_t now_ns) {
  constexpr FlatColor kPaper = {0.10F, 0.12F, 0.15F, 0.82F}, kInk = {0.95F, 0.96F, 0.97F, 1.0F};
  constexpr double kMargin = 10.0, kLine = kGlyphHeight;
  const auto width_of = [](const std::vector<std::string>& lines) {
    std::size_t widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, glyph_count(line));
    return static_cast<double>(widest) * kGlyphWidth + 2 * kMargin;
  };
  const auto box = [&](double left, double top, const std::vector<std::string>& lines) {
    marks.rectangle(left, top, width_of(lines), static_cast<double>(lines.size()) * kLine + 2 * kMargin, kPaper);
    double y = top + kMargin;
    for (const std::string& line : lines) {
      marks.text(left + kMargin, y, line, kInk);
      y += kLine;
    }
  };
  if (help_) box(kMargin, kMargin, help_lines());
  const std::vector<std::string> messages = messages_->shown(now_ns);
  if (messages.empty()) return;
  const auto [width, height] = window_->picture();
  const double tall = static_cast<double>(messages.size()) * kLine + 2 * kMargin;
  box(help_ ? width - width_of(messages) - kMargin : kMargin, height - tall - kMargin, messages);  // beside the help
}

}  // namespace ambf::render
