// What a window shows of the simulation itself, over the scene: switches, one set a window, so that each user sees what he asked for.
// The table is what keys, panel and documentation are made from. Published pictures show none of it. Pure data, any thread.
#pragma once

#include <array>
#include <string_view>

#include "render/window/keys.h"

namespace ambf::render {

struct Layers {
  bool frames = false;        // of all bodies
  bool picked_frame = false;  // of the body picked last
  bool collision = false;     // the shapes that collide
  bool joints = false;        // axes, limits and values
  bool contacts = false;      // points and forces
  bool mass = false;          // centres of mass and inertia
  bool wireframe = false;     // the triangles of what is drawn
  bool names = false;         // of bodies
  bool velocities = false;    // of centres of mass
  bool no_visuals = false;    // what is drawn of bodies is left out: the other layers alone

  bool operator==(const Layers&) const = default;
  bool any() const { return *this != Layers{}; }
};

struct LayerSwitch {
  bool Layers::*shown;
  Action action;           // of its key
  std::string_view label;  // short, for a check box
  std::string_view text;   // one line, for tool tips and the help
};

inline constexpr std::array<LayerSwitch, 10> kLayerSwitches = {{
    {&Layers::frames, Action::all_frames, "Frames", "frames of all bodies"},
    {&Layers::picked_frame, Action::picked_frame, "Frame of the picked body", "frame of the body picked last"},
    {&Layers::collision, Action::collision_shapes, "Collision shapes",
     "the shapes that collide: moving, asleep, static"},
    {&Layers::joints, Action::joints, "Joints", "axes of joints with their limits and values"},
    {&Layers::contacts, Action::contacts, "Contacts", "contact points and forces"},
    {&Layers::mass, Action::masses, "Masses", "centres of mass and boxes of equal inertia"},
    {&Layers::wireframe, Action::wireframe, "Wireframe", "the triangles of what is drawn"},
    {&Layers::names, Action::names, "Names", "names of bodies"},
    {&Layers::velocities, Action::velocities, "Velocities", "velocities of centres of mass"},
    {&Layers::no_visuals, Action::no_visuals, "Hide visuals",
     "what is drawn of bodies is hidden: the other layers alone"},
}};

// Null for what is no layer's key.
inline bool Layers::*layer_of(Action action) {
  for (const LayerSwitch& layer : kLayerSwitches) {
    if (layer.action == action) return layer.shown;
  }
  return nullptr;
}

}  // namespace ambf::render
