// The camera that a window looks through: an object of the simulation that the mouse moves by commands like anybody
// else, so that ROS users see it move and can move it too, each going on from where it is (dissertation §3.4.3); or
// one of the window's own that frames the whole scene. Main thread.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "render/camera/camera.h"
#include "render/navigation/mouse.h"
#include "render/scene/motion.h"
#include "state/abilities/command.h"
#include "state/abilities/tune.h"

namespace ambf::render {

class ViewCamera {
 public:
  // An invalid id: the window's own.
  ViewCamera(state::CommandAbility& command, state::TuneAbility& tune, state::ObjectId camera)
      : command_(command), tune_(tune), object_(camera) {}

  // Once a picture, with the newest frame and what will be drawn. `things` is all there is to see; it may be empty
  // unless wants_framing().
  void follow(const state::Frame& frame, const ScenePoses& poses, const std::vector<Sphere>& things, double aspect,
              std::int64_t now_ns);
  bool wants_framing() const { return !framed_ && (!object_.valid() || info_.frames_scene); }
  // Shows all of `things` (world; at least one) from the side that it looks from now, with the next follow().
  void frame(std::vector<Sphere> things) { asked_ = std::move(things); }

  state::ObjectId object() const { return object_; }
  const Camera& camera() const { return camera_; }
  const state::Lens& lens() const { return lens_; }
  const View& view() const { return view_; }
  bool multipass() const { return info_.multipass; }
  const state::CameraInfo& info() const { return info_; }

  void move(const View& view, std::int64_t now_ns);
  // One of the window's own begins where this one is, instead of framing the scene.
  void begin_like(const ViewCamera& other);
  void widen(double factor);  // the width of an orthographic view
  void rest();                // the mouse was let go
  // Back to this pose in its parent's frame; its own camera frames the scene anew.
  void reset(const math::Pose& T_parent_camera, std::int64_t now_ns);

 private:
  void take_over(const state::Frame& frame);
  void frame_asked(const state::Frame& frame, double aspect, std::int64_t now_ns);

  state::CommandAbility& command_;
  state::TuneAbility& tune_;
  const state::ObjectId object_;
  bool taken_over_ = false;
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  std::uint64_t epoch_ = 0;
  std::uint32_t slot_ = state::kNone;
  std::unique_ptr<state::CommandPort> port_;
  state::CameraInfo info_;
  state::Lens lens_;  // newest
  Camera camera_;
  View view_;
  math::Pose T_world_parent_;
  std::vector<Sphere> asked_;  // to be framed; empty: nothing
  bool framed_ = false;        // our own camera was placed
  bool on_its_way_ = false;    // what the mouse moved has not come back from the simulation yet
  std::int64_t moved_ns_ = 0;  // when the mouse last moved it
};

}  // namespace ambf::render
