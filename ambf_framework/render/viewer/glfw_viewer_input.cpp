// What keys and dropped files do, in whichever window.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "base/clock.h"
#include "render/viewer/detail/glfw_viewer.h"
#include "render/window/device_keys.h"
#include "render/window/drop.h"

namespace ambf::render {

void GlfwViewer::handle_inputs(const CameraWindow::Scene& scene) {
  for (const auto& window : windows_) {
    window->handle_inputs(scene, gestures_, [&](const Input& input) {
      if (const auto* key = std::get_if<KeyInput>(&input); key != nullptr && !key->released) on_key(*window, *key);
      if (const auto* drop = std::get_if<DropInput>(&input)) on_drop(*drop);
    });
  }
  if (hand_ != nullptr) hand_->publish(base::steady_ns());
}

void GlfwViewer::on_key(CameraWindow& window, const KeyInput& key) {
  constexpr unsigned kTen = 10;
  const Action action = action_of(key.key, key.modifiers, key.held);
  const bool moves = action == Action::gravity_on || action == Action::gravity_off || action == Action::picking;
  if (options_.only_watches && moves) {  // else what is asked for says itself that it is refused
    messages_->add("the world belongs to the program that shows it");
    return;
  }
  switch (action) {
    case Action::none: break;
    case Action::quit: quit_ = true; break;
    case Action::help:
      if (!window.help.shown()) {
        for (const std::string& line : help_lines()) std::printf("%s\n", line.c_str());
        std::fflush(stdout);
      }
      window.help.turn();
      break;
    case Action::frame_loaded: frame_all(window); break;
    case Action::pause:
      simulation_.run.set_paused(!frame_->run.paused);
      messages_->add(frame_->run.paused ? "running" : "paused");
      break;
    case Action::step_once: simulation_.run.step_paused(1); break;
    case Action::step_ten: simulation_.run.step_paused(kTen); break;
    case Action::reset_bodies:
      simulation_.run.reset_bodies();
      messages_->add("bodies reset");
      break;
    case Action::reset_world:
      simulation_.run.reset_world();
      messages_->add("world reset");
      break;
    case Action::reset_cameras:
      reset_cameras();
      messages_->add("cameras reset");
      break;
    case Action::gravity_on:
      simulation_.tune.set_gravity(frame_->structure->gravity_world);
      messages_->add("gravity on");
      break;
    case Action::gravity_off:
      simulation_.tune.set_gravity({});
      messages_->add("gravity off");
      break;
    case Action::picking:
      gestures_.picking = !gestures_.picking;
      messages_->add(gestures_.picking ? "picking: the left button drags bodies" : "picking off");
      break;
    case Action::hand: messages_->add("no device here is moved by keyboard and mouse"); break;
    case Action::remove_picked: remove_picked(); break;
    case Action::full_screen: toggle_full_screen(); break;
    case Action::labels: labels_ = !labels_; break;
    case Action::invert_mouse:
      gestures_.inverted = !gestures_.inverted;
      messages_->add(gestures_.inverted ? "mouse: up and down inverted" : "mouse: up and down as usual");
      break;
    case Action::mirror:
      gestures_.mirrored = !gestures_.mirrored;
      messages_->add(gestures_.mirrored ? "pictures mirrored" : "pictures not mirrored");
      break;
    case Action::normal_maps:
      normal_maps_ = !normal_maps_;
      messages_->add(normal_maps_ ? "normal maps on" : "normal maps off");
      break;
    case Action::device_gain:
    case Action::device_mode:
    case Action::device_rotation_camera:
    case Action::device_rotation_world:
    case Action::device_forces:
      messages_->add(
          act_on_devices(*binding_of(key.key, key.modifiers, key.held), simulation_.devices, window.view().object()));
      break;
    case Action::later:
      if (const std::string text = later_text(key.key, key.modifiers); told_later_.insert(text).second) {
        log_.info("%s", text.c_str());
        messages_->add(text);
      }
      break;
    case Action::layer: switch_layer(window, binding_of(key.key, key.modifiers, key.held)->layer); break;
    case Action::panel:
    case Action::next_camera:
    case Action::screenshot:
    case Action::film:
    case Action::record_data:
    case Action::measure: break;  // a part's (panel/panel_part.h, scene_marks.h)
  }
}

void GlfwViewer::switch_layer(CameraWindow& window, LayerId layer) {
  if (layer == LayerId::picked_frame && !picked_.valid()) {
    messages_->add("no body was picked yet");
  } else {
    window.layers.toggle(layer);
  }
}

void GlfwViewer::remove_picked() {
  const std::uint32_t object = state::find(*frame_->structure, picked_);
  if (object == state::kNone) {
    messages_->add("no body was picked yet, or it is gone");
    return;
  }
  const std::string name = frame_->structure->objects[object].name;
  simulation_.edit.remove(name, [messages = messages_, name](const state::Outcome& outcome) {
    messages->add(outcome.success ? "removed " + name : "not removed: " + outcome.message);
  });
}

void GlfwViewer::reset_cameras() {
  const std::int64_t now_ns = base::steady_ns();
  const state::Structure& structure = *frame_->structure;
  for (const auto& window : windows_) window->view().reset(homes_.home(window->view().object()), now_ns);
  for (const state::CameraInfo& camera : structure.cameras) {
    const state::ObjectId id = structure.objects[camera.object].id;
    const bool shown = std::any_of(windows_.begin(), windows_.end(),
                                   [&](const auto& window) { return window->view().object() == id; });
    if (shown) continue;
    if (const auto port = simulation_.command.bind(id, state::Source::pointer)) {
      port->post(state::PoseCommand{true, homes_.home(id)});
    }
  }
}

void GlfwViewer::on_drop(const DropInput& drop) {
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
    simulation_.edit.load(std::move(request), [messages = messages_, &log = log_, name](const state::Outcome& outcome) {
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

}  // namespace ambf::render
