// The viewer of one window. Private to render/ (viewer.h is its face). Main thread.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "render/messages.h"
#include "render/motion.h"
#include "render/painter.h"
#include "render/picker.h"
#include "render/quality.h"
#include "render/view_camera.h"
#include "render/viewer.h"
#include "render/window.h"

namespace ambf::render {

class WindowViewer final : public Viewer {
 public:
  WindowViewer(state::Control& control, base::Log& log);
  ~WindowViewer() override;
  bool start(std::string& why);
  bool draw() override;

 private:
  void handle(const Input& input);
  void on_key(const KeyInput& key);
  void on_button(const ButtonInput& button);
  void on_motion(const MotionInput& motion);
  void on_wheel(const WheelInput& wheel);
  void on_drop(const DropInput& drop);
  void remove_picked();

  bool draw_picture(std::int64_t now_ns);
  void draw_marks(FlatDrawing& marks, const Mat4& world_to_clip, const ScenePoses& poses, std::int64_t now_ns);
  void draw_labels(FlatDrawing& marks, std::int64_t now_ns);
  void tell_rates(std::int64_t now_ns);
  void pace();

  state::Control& control_;
  base::Log& log_;
  std::unique_ptr<state::FrameReader> reader_;
  const state::Frame* frame_ = nullptr;  // newest; valid until the next picture
  std::shared_ptr<Messages> messages_ = std::make_shared<Messages>();

  Gl gl_;
  std::unique_ptr<Display> display_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<SharedStore> shared_;
  std::unique_ptr<Painter> painter_;  // both gone before the window
  bool software_ = false;
  QualityGovernor quality_{false};

  Motion motion_;
  ViewCamera view_;
  Picker picker_;

  bool quit_ = false, help_ = false, picking_ = false, all_frames_ = false;
  std::optional<state::ObjectId> framed_body_;  // Shift+V
  bool rotating_ = false, panning_ = false, looking_ = false;
  double x_ = 0.0, y_ = 0.0;  // of the pointer

  std::uint64_t pictures_ = 0, pictures_told_ = 0;
  std::int64_t told_ns_ = 0, next_ns_ = 0;
};

}  // namespace ambf::render
