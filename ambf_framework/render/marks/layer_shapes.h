// What the built-in layers of a window (layers.h) show of one frame, as lists for world_shapes.h. Sizes are chosen so
// that marks can be read at any distance: between a minimum and a maximum in pixels. Pure functions, any thread.
#pragma once

#include "render/camera/camera.h"
#include "render/marks/layers.h"
#include "render/marks/world_shapes.h"
#include "render/scene/body_looks.h"
#include "render/scene/motion.h"
#include "state/abilities/devices.h"
#include "state/frame.h"

namespace ambf::render {

// How long a pixel is at a point.
class PixelScale {
 public:
  // `ui_scale`: 2 on a high-density screen.
  PixelScale(const Camera& camera, int width_px, int height_px, double ui_scale);
  double metres(const math::Vec3& point_world, double px) const;
  double ui() const { return ui_scale_; }

 private:
  math::Pose T_camera_world_;
  double near_m_, per_metre_ = 0.0, constant_ = 0.0;  // metres a pixel: per_metre * depth + constant
  double ui_scale_;
};

struct LayerInput {
  const state::Frame& frame;
  const ScenePoses& poses;  // of the same structure
  state::ObjectId picked;   // the body picked last
  PixelScale scale;
  std::vector<BodyLook> looks{};                  // by slot; empty: all as loaded
  const state::DeviceAbility* devices = nullptr;  // null: there are no input devices
};

// All that `layers` shows, and wireframes of the bodies that look so.
void draw_layers(const Layers& layers, const LayerInput& in, WorldShapes& out);

// One layer each, for the table of layers.
void draw_frames(const LayerInput& in, WorldShapes& out);
void draw_picked_frame(const LayerInput& in, WorldShapes& out);
void draw_collision_shapes(const LayerInput& in, WorldShapes& out);
void draw_joints(const LayerInput& in, WorldShapes& out);
void draw_contacts(const LayerInput& in, WorldShapes& out);
void draw_masses(const LayerInput& in, WorldShapes& out);
void draw_wireframe(const LayerInput& in, WorldShapes& out);
void draw_names(const LayerInput& in, WorldShapes& out);
void draw_velocities(const LayerInput& in, WorldShapes& out);
void draw_device_frames(const LayerInput& in, WorldShapes& out);
void draw_ghosts(const LayerInput& in, WorldShapes& out);
void draw_sensors(const LayerInput& in, WorldShapes& out);
void draw_actuators(const LayerInput& in, WorldShapes& out);
void draw_sensor_skins(const LayerInput& in, WorldShapes& out);

// Bodies that pointers of any user hold: by which point, where that is pulled to and with what force. Always shown.
void draw_picks(const LayerInput& in, WorldShapes& out);

// Each tool that an input device moves: a disc in its user's colour with the device's name, and why it does not follow.
// With `visible`: a ball at REF. Always shown.
void draw_devices(const LayerInput& in, WorldShapes& out);

// The looks of ghost objects that are visible. Always shown.
void draw_visible_ghosts(const LayerInput& in, WorldShapes& out);

// The sensors that their files make `visible`. Always shown.
void draw_visible_sensors(const LayerInput& in, WorldShapes& out);
// The actuators that theirs do, likewise.
void draw_visible_actuators(const LayerInput& in, WorldShapes& out);

// Around what is drawn of a body, else around its collision shape; body frame. Radius 0 when it has neither.
Sphere bounds_of(const state::BodyInfo& body);
// Blue (1 mN and less), cyan, green (0.1 N), yellow (1 N), orange, red (100 N and more), a decade each.
DebugColor force_color(double newtons);
// An arrow whose length and colour are logarithmic (force_color); none without a force.
void draw_force(const LayerInput& in, const math::Vec3& at_world, const math::Vec3& force_world, WorldShapes& out);
// "2.5 N", "37 mN", "1.2 kN".
std::string force_text(double newtons);

}  // namespace ambf::render
