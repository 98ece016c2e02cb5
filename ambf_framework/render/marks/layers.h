// Layers: what a window shows of the simulation itself, over the scene. One table of them, from which keys, panel and
// help are made; built-in layers are its first entries, a kind of object that is registered beside the product's
// (state/kinds.h) adds its own. Each window has its own switches, so that each user sees what he asked for. Published
// pictures show none of it.
#pragma once

#include <bitset>
#include <cstdint>
#include <string>
#include <vector>

namespace ambf::render {

class WorldShapes;  // render/marks/world_shapes.h
struct LayerInput;  // render/marks/layer_shapes.h

// Place in the table. Enumerators are the built-in layers.
enum class LayerId : std::uint8_t {
  frames,         // of all bodies
  picked_frame,   // of the body picked last
  collision,      // the shapes that collide
  joints,         // axes, limits and values
  contacts,       // points and forces
  mass,           // centres of mass and inertia
  wireframe,      // the triangles of what is drawn
  names,          // of bodies
  velocities,     // of centres of mass
  no_visuals,     // what is drawn of bodies is left out: the other layers alone
  device_frames,  // the 17 frames of each input device
  ghosts,         // ghost objects, and which of them feel something
  sensors,        // rays and what they sense
  actuators,      // where they sit and what they hold
  sensor_skins    // surfaces through what rays sense
};

struct LayerInfo {
  std::string key;     // that switches it: a letter, "J"; empty: the panel alone does
  bool shift = false;  // with Shift
  std::string help;    // of the key: "joints with limits and values on or off"
  std::string label;   // short, for a check box; unique
  std::string text;    // one line, for tool tips
  // Adds its marks to those of one picture. Null: it changes what is drawn of the scene itself.
  void (*draw)(const LayerInput& in, WorldShapes& out) = nullptr;
};

inline constexpr std::size_t kMaxLayers = 64;

// Before the first window opens, from one thread. Throws std::logic_error when the label or the key is another layer's
// already, or the table is full.
LayerId add_layer(LayerInfo info);

// by LayerId. Any thread, once all are added.
const std::vector<LayerInfo>& all_layers();

// Which of them one window shows.
class Layers {
 public:
  bool shows(LayerId layer) const { return shown_[static_cast<std::size_t>(layer)]; }
  void show(LayerId layer, bool shown = true) { shown_[static_cast<std::size_t>(layer)] = shown; }
  void toggle(LayerId layer) { shown_.flip(static_cast<std::size_t>(layer)); }

 private:
  std::bitset<kMaxLayers> shown_;
};

}  // namespace ambf::render
