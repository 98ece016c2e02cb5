// The panel over a real simulation, without a window: what a user does goes in as inputs, pictures are laid out and not
// drawn.
#pragma once

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "../runtime/simulation_rig.h"
#include "render/marks/layers.h"
#include "render/navigation/view_camera.h"
#include "render/panel/panel_model.h"
#include "render/panel/panel_ui.h"
#include "render/panel/ui.h"
#include "render/scene/body_looks.h"
#include "render/scene/motion.h"
#include "render/window/measure.h"
#include "render/window/window_part.h"
#include "render/window/window_recorder.h"
#include "tests/support/views.h"

namespace ambf::render::testing {

// A table with a box, and a jointed arm that nothing holds up but its joints; a camera and a light.
inline const std::string kPanelScene = R"(
bodies: [BODY table, BODY box, BODY base, BODY upper, BODY lower]
joints: [JOINT shoulder, JOINT elbow]
namespace: /test/
BODY table: {name: table, mass: 0, collision shape: BOX, collision geometry: {x: 2, y: 2, z: 0.2},
  location: {position: {x: 0, y: 0, z: 0.9}, orientation: {r: 0, p: 0, y: 0}}}
BODY box: {name: box, mass: 1, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0.5, y: 0, z: 1.05}, orientation: {r: 0, p: 0, y: 0}}}
BODY base: {name: base, mass: 0, collision shape: BOX, collision geometry: {x: 0.02, y: 0.02, z: 0.02},
  location: {position: {x: 0, y: 0, z: 3}, orientation: {r: 0, p: 0, y: 0}}}
BODY upper: {name: upper, mass: 0.5, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}, collision shape: BOX,
  collision geometry: {x: 0.02, y: 0.02, z: 0.2}, location: {position: {x: 0, y: 0, z: 2.9}, orientation: {r: 0, p: 0,
  y: 0}}}
BODY lower: {name: lower, mass: 0.5, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}, collision shape: BOX,
  collision geometry: {x: 0.02, y: 0.02, z: 0.2}, location: {position: {x: 0, y: 0, z: 2.7}, orientation: {r: 0, p: 0,
  y: 0}}}
JOINT shoulder: {name: shoulder, parent: BODY base, child: BODY upper, type: revolute, joint limits: {low: -1.5,
  high: 1.5},
  max motor impulse: 1, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0.1}, parent axis: {x: 0, y: 1,
  z: 0},
  child axis: {x: 0, y: 1, z: 0}}
JOINT elbow: {name: elbow, parent: BODY upper, child: BODY lower, type: revolute, joint limits: {low: -1.5, high: 1.5},
  max motor impulse: 1, parent pivot: {x: 0, y: 0, z: -0.1}, child pivot: {x: 0, y: 0, z: 0.1}, parent axis: {x: 0,
  y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
)";

// With a camera and a light.
inline scene::World panel_world() {
  scene::World world = runtime::test::empty_world();
  world.cameras.push_back(test_camera({3, 0, 2}));
  world.lights.push_back(test_light({0, 0, 4}));
  return world;
}

class PanelRig {
 public:
  // High enough to show a whole tab. On a dense screen inputs count in other units than pictures.
  const int width, height;
  const double density;
  static constexpr std::int64_t kPicture_ns = 20'000'000;

  explicit PanelRig(const std::string& settings = "", int width_px = 1600, int height_px = 2600,
                    double density_px = 2.0, DataRecording* recording = nullptr, const std::string& scene = "",
                    state::DeviceAbility* devices = nullptr)
      : width(width_px),
        height(height_px),
        density(density_px),
        rig({}, kPanelScene, panel_world()),
        messages(std::make_shared<Messages>()),
        model({abilities_with(devices), rig.log, &tail, messages, settings, recording, scene}),
        ui(model, {[this](const std::string& text) { clipboard = text; }, [this] { return clipboard; }}),
        view(std::make_unique<ViewCamera>(rig.simulation, rig.simulation, state::ObjectId{})),
        recorder(rig.log, messages) {
    rig.simulation.set_paused(true);
    rig.simulation.begin();
    rig.step(1);
    ui.set_open(true);
    pictures(3);
  }

  state::Abilities abilities_with(state::DeviceAbility* devices) {
    state::Abilities abilities = rig.simulation.abilities();
    abilities.devices = devices;
    return abilities;
  }

  // One picture of the newest frame.
  void picture() {
    now_ns += kPicture_ns;
    const state::Frame& frame = rig.frame();
    motion.take(frame);
    const ScenePoses& poses = motion.at(frame.steady_ns);
    if (camera != view->object()) view = std::make_unique<ViewCamera>(rig.simulation, rig.simulation, camera);
    view->follow(frame, poses, {{{0, 0, 1}, 2.0}}, 1.0, now_ns);
    moment.window = 1;
    moment.frame = &frame;
    moment.poses = &poses;
    moment.now_ns = now_ns;
    moment.shows.layers = &layers;
    moment.shows.looks = &looks;
    moment.shows.measure = &measure;
    moment.choices.picked = picked;
    moment.choices.set_picked = &picked;
    moment.choices.set_camera = &camera;
    moment.recorder = &recorder;
    moment.camera_object = view->object();
    moment.view = view.get();
    moment.camera = view->camera();
    moment.sizes.picture_width = moment.sizes.window_picture_width = width;
    moment.sizes.picture_height = height;
    moment.sizes.width = width / density;
    moment.sizes.height = height / density;
    moment.sizes.scale = 1.0;
    model.observe(frame, now_ns);
    ui.build(moment);
    // As a window does that paints what is asked for.
    if (recorder.wants(frame.sim_time)) {
      recorder.take({16, 8, std::vector<std::uint8_t>(std::size_t{3} * 16 * 8, 77)}, frame.sim_time);
    }
  }
  void pictures(int count) {
    for (int i = 0; i < count; ++i) picture();
  }

  std::vector<std::string> said() { return messages->shown(now_ns); }

  bool put(const Input& input) { return ui.on_input(moment, input); }
  bool shown(const std::string& widget) const { return ui.place(widget) != nullptr; }

  struct At {
    double x, y;
  };
  // A point of a widget in window units: 0 is its left edge, 1 its right one.
  At at(const std::string& widget, double part = 0.5) const {
    const WidgetPlace* place = ui.place(widget);
    if (place == nullptr) {
      ADD_FAILURE() << "there is no " << widget;
      return {-1, -1};
    }
    return {(place->left + part * (place->right - place->left)) / density,
            0.5 * (place->top + place->bottom) / density};
  }
  void click_at(const At& at) {
    put(MotionInput{at.x, at.y, false});
    picture();
    put(ButtonInput{MouseButton::left, true, {}, at.x, at.y});
    picture();
    put(ButtonInput{MouseButton::left, false, {}, at.x, at.y});
    pictures(2);
  }
  void click(const std::string& widget, double part = 0.5) { click_at(at(widget, part)); }
  void drag(const std::string& widget, double from, double to) {
    const At a = at(widget, from), b = at(widget, to);
    put(MotionInput{a.x, a.y, false});
    picture();
    put(ButtonInput{MouseButton::left, true, {}, a.x, a.y});
    picture();
    put(MotionInput{b.x, b.y, false});
    pictures(2);
    put(ButtonInput{MouseButton::left, false, {}, b.x, b.y});
    pictures(2);
  }
  void key(const std::string& name, Modifiers modifiers = {}) {
    put(KeyInput{name, modifiers, false, false});
    picture();
    put(KeyInput{name, modifiers, false, true});
    picture();
  }
  void type(const std::string& text) {
    for (const char c : text) {
      put(TextInput{static_cast<char32_t>(c)});
      picture();
    }
  }
  // Replaces what a number field holds, as by a double click and typing.
  void enter(const std::string& field, const std::string& number) {
    const At where = at(field);
    put(MotionInput{where.x, where.y, false});
    picture();
    for (int i = 0; i < 2; ++i) {
      put(ButtonInput{MouseButton::left, true, {}, where.x, where.y});
      picture();
      put(ButtonInput{MouseButton::left, false, {}, where.x, where.y});
      picture();
    }
    pictures(2);
    type(number);
    key("Enter");
    pictures(2);
  }
  void tab(const std::string& name) { click("tab/" + name); }

  // Lets the simulation answer and shows what came of it.
  template <class Condition>
  bool until(Condition good) {
    const bool came = rig.wait_until([&](const state::Frame& frame) { return good(frame); });
    pictures(2);
    return came;
  }
  void run(unsigned steps) {
    for (unsigned i = 0; i < steps; i += 20) {  // as pictures come: what is held is kept alive
      rig.step(20);
      picture();
    }
  }
  state::ObjectId joint(const std::string& name) {
    const auto structure = rig.simulation.structure();
    return structure->objects[state::find(*structure, name, state::ObjectKind::joint)].id;
  }
  std::uint32_t slot(const std::string& name, state::ObjectKind kind) {
    const auto structure = rig.simulation.structure();
    return structure->objects[state::find(*structure, name, kind)].slot;
  }
  const state::JointState& joint_state(const std::string& name) {
    return rig.frame().joints[slot(name, state::ObjectKind::joint)];
  }

  runtime::test::Rig rig;
  base::LogTail tail;
  std::shared_ptr<Messages> messages;
  PanelModel model;
  std::string clipboard;
  PanelUi ui;
  state::ObjectId camera;  // through which the window looks; invalid: its own
  std::unique_ptr<ViewCamera> view;
  WindowRecorder recorder;
  Motion motion;
  Layers layers;
  BodyLooks looks;
  Measure measure;
  state::ObjectId picked;
  WindowMoment moment;
  std::int64_t now_ns = 1'000'000'000;
};

}  // namespace ambf::render::testing
