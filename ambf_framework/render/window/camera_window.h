// The window of one camera: draws what the camera sees; gestures in it move the camera and pull at bodies. Holds what
// belongs to its own OpenGL context. Main thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/camera/stereo.h"
#include "render/marks/layers.h"
#include "render/navigation/view_camera.h"
#include "render/pictures/picture_composer.h"
#include "render/scene/body_looks.h"
#include "render/window/detail/glfw_window.h"
#include "render/window/detail/picker.h"
#include "render/window/help_card.h"
#include "render/window/measure.h"
#include "render/window/messages.h"
#include "render/window/window_part.h"
#include "render/window/window_recorder.h"
#include "state/abilities/abilities.h"

namespace ambf::render {

class CameraWindow {
 public:
  // Shared by all windows; owned by the viewer, which outlives them.
  struct Shared {
    state::Abilities simulation;
    Display& display;
    GlfwWindow& root;  // hidden; keeps what is shared alive, and is current between two windows' calls
    const Gl& gl;
    SharedStore& store;
    state::ObjectId& picked;  // the body picked last, in whichever window
    base::Log& log;
    std::shared_ptr<Messages> messages;
    std::vector<std::unique_ptr<WindowPart>>& parts;
  };
  // The scene that all windows draw at one moment.
  struct Scene {
    const state::Frame& frame;
    const ScenePoses& poses;
    std::vector<Sphere> things;  // bounds of drawn bodies; filled only when a view frames them
    Quality quality;
    std::vector<std::uint32_t> outlined;  // slots of bodies that pointers hold
    std::int64_t now_ns = 0;
    std::vector<std::string> labels;  // at the lower edge
    bool normal_maps = true;
    bool software = false;  // the processor draws: what rests is painted once, better
  };

  // Mouse settings of all windows.
  struct Gestures {
    bool picking = false;   // the left button drags bodies
    bool inverted = false;  // vertical rotation inverted
    bool mirrored = false;  // the picture is upside down
  };

  // For `camera`; with a view of its own when that is invalid. Null with the reason in `why`.
  static std::unique_ptr<CameraWindow> open(const Shared& shared, unsigned number, state::ObjectId camera,
                                            const Area& place, std::string& why);
  ~CameraWindow();

  unsigned number() const { return number_; }
  GlfwWindow& window() { return *window_; }
  ViewCamera& view() { return *view_; }
  const ViewCamera& view() const { return *view_; }
  state::ObjectId camera() const { return camera_; }  // whose window it is, even while it shows another
  void serve(state::ObjectId camera);                 // replaces its camera
  void set_title(const std::string& title);           // when it differs

  // What happened in it, in order: to the parts, then to the mouse, else (keys, drops) to `others`, which may change
  // `gestures`.
  void handle_inputs(const Scene& scene, const Gestures& gestures, const std::function<void(const Input&)>& others);
  // Draws one picture into the window's context, which is current afterwards. False when that is impossible, with the
  // reason in `why`.
  bool draw(const Scene& scene, std::string& why);
  // How the last picture came about.
  enum class Painting { repeated, at_rest, in_motion };
  Painting painting() const { return painting_; }
  WindowMoment moment(const Scene& scene);
  // Whether some of `things` (world) is in view.
  bool shows_any(const std::vector<Sphere>& things) const;

  Layers layers;
  BodyLooks looks;
  Measure measure;
  HelpCard help;

 private:
  CameraWindow(const Shared& shared, unsigned number, state::ObjectId camera);
  void look_through(state::ObjectId camera);
  WindowSizes sizes() const;
  std::pair<double, double> scene_size() const;  // width and height in window units
  bool draw_eye(const Scene& scene, const EyeView& eye, int height, std::string& why);
  void choose_quality(const Scene& scene, PictureJob& job);
  void record(int left);
  void on_button(const ButtonInput& button);
  void on_motion(const MotionInput& motion);
  void on_wheel(const WheelInput& wheel);

  const Shared shared_;
  const unsigned number_;
  std::unique_ptr<GlfwWindow> window_;
  std::unique_ptr<PictureComposer> painter_;  // gone before the window
  state::ObjectId camera_, wanted_;           // whose window it is; the one to show
  std::unique_ptr<ViewCamera> view_;
  Painting painting_ = Painting::in_motion;
  Quality painted_;  // of the picture at hand
  std::int64_t still_since_ns_ = 0;
  WindowRecorder recorder_;
  WindowPicture picture_;  // for the recorder, under way
  bool recording_ = false;
  bool whole_ = false;  // the scene is drawn below what covers it, too
  Picker picker_;
  std::string title_;
  std::shared_ptr<const Lettering> letters_;  // of the density of its screen
  Gestures gestures_;
  EyeView pick_eye_;  // in whose picture the grasp began
  bool rotating_ = false, panning_ = false, looking_ = false;
  double x_ = 0.0, y_ = 0.0;  // of the pointer, in the picture before it is mirrored
};

}  // namespace ambf::render
