#include "render/marks/layers.h"

#include <stdexcept>

#include "render/marks/layer_shapes.h"
#include "render/marks/layer_soft_bodies.h"

namespace ambf::render {

namespace {

// In the order of LayerId's enumerators.
std::vector<LayerInfo> built_in_layers() {
  return {
      {"V", false, "frames of all bodies on or off", "Frames", "frames of all bodies", draw_frames},
      {"V", true, "frame of the body picked last on or off", "Frame of the picked body",
       "frame of the body picked last", draw_picked_frame},
      {"H", true, "collision shapes on or off", "Collision shapes", "the shapes that collide: moving, asleep, static",
       draw_collision_shapes},
      {"J", true, "joints with limits and values on or off", "Joints", "axes of joints with their limits and values",
       draw_joints},
      {"C", true, "contacts with forces on or off", "Contacts", "contact points and forces", draw_contacts},
      {"M", true, "centres of mass and inertia on or off", "Masses", "centres of mass and boxes of equal inertia",
       draw_masses},
      {"W", true, "wireframe on or off", "Wireframe", "the triangles of what is drawn", draw_wireframe},
      {"B", true, "names of bodies on or off", "Names", "names of bodies", draw_names},
      {"S", true, "velocities on or off", "Velocities", "velocities of centres of mass", draw_velocities},
      {"G", true, "visuals of bodies off or on: to see collision shapes alone", "Hide visuals",
       "what is drawn of bodies is hidden: the other layers alone", nullptr},
      {"F", true, "the 17 frames of each input device on or off", "Device frames",
       "hand, tool, reference and camera of each input device, by name", draw_device_frames},
      {"O", true, "ghost objects on or off", "Ghost objects",
       "the shapes of ghost objects: orange where they feel something", draw_ghosts},
      {"S", false, "sensors: show or hide them", "Sensors", "rays from red to green, what they sense, and their forces",
       draw_sensors},
      {"A", false, "actuators: show or hide them", "Actuators", "where actuators sit, and what they hold",
       draw_actuators},
      {"K", true, "skins of sensors: surfaces through what their rays sense", "Skins of sensors",
       "surfaces through the ends of rays, pressed in where these sense something", draw_sensor_skins},
      // No other file names these.
      {"L", true, "nodes and links of soft bodies on or off", "Soft nodes",
       "nodes and links of soft bodies: red fixed, orange held", draw_soft_nodes},
      {"E", true, "strain of soft bodies on or off", "Soft strain",
       "links of soft bodies: blue shorter, red longer than as loaded, full at 10 %", draw_soft_strain},
  };
}

std::vector<LayerInfo>& table() {
  static std::vector<LayerInfo> entries = [] {
    std::vector<LayerInfo> layers = built_in_layers();
    layers.reserve(kMaxLayers);  // the table of keys refers to their texts
    return layers;
  }();
  return entries;
}

}  // namespace

LayerId add_layer(LayerInfo info) {
  if (table().size() >= kMaxLayers) throw std::logic_error("layer " + info.label + ": there are too many layers");
  for (const LayerInfo& other : table()) {
    if (other.label == info.label) throw std::logic_error("there is a layer " + info.label + " already");
    if (!info.key.empty() && other.key == info.key && other.shift == info.shift)
      throw std::logic_error("layer " + info.label + ": its key is that of " + other.label);
  }
  table().push_back(std::move(info));
  return static_cast<LayerId>(table().size() - 1);
}

const std::vector<LayerInfo>& all_layers() { return table(); }

}  // namespace ambf::render
