// Something beside the scene that lives in every window: the panel, layers, measuring. Parts get inputs before the
// window's own gestures and keys do, and draw after the scene. Main thread.
#pragma once

#include <cstdint>

#include "render/camera/camera.h"
#include "render/marks/layers.h"
#include "render/marks/world_shapes.h"
#include "render/scene/motion.h"
#include "render/window/input.h"

namespace ambf::render {

class BodyLooks;
class Measure;
class ViewCamera;
class WindowRecorder;

// How large a window is, and how its inputs count.
// The scene is shown at the left of the window, beside what a part covers.
struct WindowSizes {
  int picture_width = 0, picture_height = 0;  // of the scene, px
  double width = 0.0, height = 0.0;           // of the scene, in window units, as inputs count
  int window_picture_width = 0;               // of the whole window, px
  bool mirrored = false;                      // the picture is upside down: inputs count from its lower edge
  double scale = 1.0;                         // of text and widths: 2 on a high-density screen
};

// What a window shows beside the scene, and how; every part may change it. All are set, except in tests of a part that
// needs fewer.
struct WindowShows {
  Layers* layers = nullptr;
  BodyLooks* looks = nullptr;  // of single bodies
  Measure* measure = nullptr;
};

// What users chose, and where a part says that it chooses otherwise.
struct WindowChoices {
  state::ObjectId picked;  // the body picked last, in whichever window
  state::ObjectId* set_picked = nullptr;
  state::ObjectId* set_camera = nullptr;  // through which the window is to look; invalid: its own
};

// One window at one moment. Valid during the call.
struct WindowMoment {
  unsigned window = 0;  // its number, from 1; never changes
  std::int64_t now_ns = 0;
  const state::Frame* frame = nullptr;
  const ScenePoses* poses = nullptr;
  WindowSizes sizes;
  WindowShows shows;
  WindowChoices choices;
  WindowRecorder* recorder = nullptr;  // takes screenshots and films of the window
  ViewCamera* view = nullptr;          // through which the window looks; a part may move it
  state::ObjectId camera_object;       // invalid: the window's own camera
  Camera camera;
};

class WindowPart {
 public:
  virtual ~WindowPart() = default;

  // One input in this window. True: this part consumed it, no other part gets it.
  virtual bool on_input(const WindowMoment&, const Input&) { return false; }
  // A part before this one consumed the input.
  virtual void on_consumed(const WindowMoment&, const Input&) {}
  // Lines, shapes and texts in the scene. In stereo called once per eye, with that eye's camera and picture size.
  virtual void draw_debug(const WindowMoment&, WorldShapes&) {}
  // Over the finished picture: the window's own context is current (vertex arrays and framebuffers belong to one
  // context, everything else is shared by all windows) and its framebuffer 0 bound. Leave no state behind but what
  // SceneRenderer::draw sets anew.
  virtual void draw_over(const WindowMoment&) {}
  // How much it covers at the right of this window, px: the scene is shown beside it.
  virtual int covered(unsigned /*window*/) const { return 0; }
  // A window is about to close; its context is current.
  virtual void on_close(unsigned /*window*/) {}
};

}  // namespace ambf::render
