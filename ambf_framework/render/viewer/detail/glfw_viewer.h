// The Viewer (viewer.h) on GLFW: a window for each visible camera, or one of its own where there is none. Owns what the
// windows share: frame reader, motion, meshes and shadows, messages, and the keys that act everywhere. Main thread.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "render/drawing/shared_store.h"
#include "render/navigation/camera_homes.h"
#include "render/scene/motion.h"
#include "render/scene/quality.h"
#include "render/window/camera_window.h"
#include "render/window/hand_input.h"
#include "render/window/messages.h"
#include "render/window/viewer.h"

namespace ambf::render {

class GlfwViewer final : public Viewer {
 public:
  GlfwViewer(const state::Abilities& simulation, base::Log& log, const ViewerOptions& options);
  ~GlfwViewer() override;
  bool start(std::string& why);
  bool draw() override;
  bool display_lost() const override { return display_ != nullptr && display_->lost(); }

 private:
  bool open_shared(std::string& why);
  // One window per visible camera. False when no window is left, with the reason in `why`.
  bool match_windows(const state::Structure& structure, std::string& why);
  bool open_window(state::ObjectId camera, unsigned monitor, unsigned expected, std::string& why);
  void close_windows();  // which users closed
  Area place_on(unsigned monitor, unsigned expected) const;
  std::string title_of(const CameraWindow& window) const;
  std::vector<std::string> devices_of(const CameraWindow& window) const;

  void handle_inputs(const CameraWindow::Scene& scene);
  void on_key(CameraWindow& window, const KeyInput& key);
  void on_drop(const DropInput& drop);
  void remove_picked();
  void follow_loads(const ScenePoses& poses);
  void frame_all(CameraWindow& window);
  void switch_layer(CameraWindow& window, LayerId layer);
  void reset_cameras();
  void toggle_full_screen();

  bool draw_frame();
  bool draw_windows(const CameraWindow::Scene& scene);
  std::vector<std::string> labels() const;
  void choose_pace_maker();
  void tell_rates(std::int64_t now_ns);
  void pace();
  bool all_hidden() const;

  const state::Abilities simulation_;
  base::Log& log_;
  const ViewerOptions options_;
  std::unique_ptr<state::FrameReader> reader_;
  const state::Frame* frame_ = nullptr;  // newest; valid until the next picture
  std::shared_ptr<Messages> messages_ = std::make_shared<Messages>();

  Gl gl_;
  std::unique_ptr<Display> display_;
  std::unique_ptr<GlfwWindow> root_;
  std::unique_ptr<SharedStore> store_;
  bool software_ = false;
  QualityGovernor quality_{false};
  Motion motion_;
  CameraHomes homes_;
  state::ModelId newest_model_ = state::kWorldModel;    // that views have followed
  bool still_ = false;                                  // nothing moved in the last picture of any window
  state::ObjectId picked_;                              // the body picked last, in whichever window
  std::vector<std::unique_ptr<WindowPart>> parts_;      // the first gets inputs first and draws last
  HandInput* hand_ = nullptr;                           // one of them; null: no such device
  std::vector<std::unique_ptr<CameraWindow>> windows_;  // in order of their numbers
  std::uint64_t matched_version_ = ~std::uint64_t{0};
  std::vector<state::ObjectId> closed_;     // cameras whose windows a user closed
  const GlfwWindow* pace_maker_ = nullptr;  // the one window that waits for its display

  bool quit_ = false, full_screen_ = false, labels_ = true, normal_maps_ = true;
  CameraWindow::Gestures gestures_;
  std::set<std::string> told_later_;  // keys without an action yet that were reported

  std::uint64_t pictures_ = 0, pictures_told_ = 0;
  std::int64_t told_ns_ = 0, next_ns_ = 0;
  double rate_ = 0.0;       // pictures a second, of each window
  double drawing_s_ = 0.0;  // wall time of drawing since the last report
};

}  // namespace ambf::render
