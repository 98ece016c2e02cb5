// The ability to change what exists: load, unload, remove, reparent. The loader thread does it; nothing waits for it or
// for the physics thread. Any thread. C++17.
#pragma once

#include <optional>
#include <string>

#include "math/types.h"
#include "state/abilities/outcome.h"
#include "state/ids.h"

namespace ambf::state {

// What an input device brings (its key `simulated multibody`): of its bodies only the root link has topics,
// simulated_device/<device> in its namespace.
struct DeviceModel {
  std::string device;
  std::string root_link;                     // as the device file names it; empty: the body with the fewest parents
  std::optional<math::Pose> T_world_root{};  // where the root link is put; nothing: where its file says
};

struct LoadRequest {
  std::string path;          // ADF file; or
  std::string text;          // ADF text (paths in it are relative to `path`, or to the working directory)
  std::string name_prefix;   // put before the model's namespaces
  math::Pose T_world_model;  // where to place the model
  bool check_only = false;   // parse and report, load nothing
  std::optional<DeviceModel> of_device{};
  // Of a robot written as URDF; ADF ignores them.
  bool free_base = false;    // the root link moves; else it is static
  bool merge_fixed = false;  // links that fixed joints connect become one body
  bool not_saved = false;    // a part of the program loads it anew at each start: saved scenes leave it out
};

// A loaded model as an ADF file (the text that was read, edited where it has changed), or the whole scene as a folder.
struct SaveModelRequest {
  std::string model;          // as it is listed (ModelInfo::name); empty: the scene
  std::string path;           // empty: its own; ending in /: a folder, with meshes; of a scene: its folder
  bool current_pose = false;  // bodies where they are now, in the world; else as they were read
  bool overwrite = false;     // a file that exists is replaced; else nothing is written
};

class EditAbility {
 public:
  virtual ~EditAbility() = default;
  virtual void load(LoadRequest request, Completion done) = 0;
  virtual void unload(const std::string& model, Completion done) = 0;
  virtual void remove(const std::string& object, Completion done) = 0;
  // Writes a file and changes nothing else. Of the outcome, `model` is the path that was written, `bytes` its size.
  virtual void save(SaveModelRequest request, Completion done) = 0;
  // Attaches a camera or a light to the object named `parent` (rules of the ADF key; empty: the world), keeping its
  // pose in the world. A world reset restores the loaded parent.
  virtual void set_parent(ObjectId object, const std::string& parent, Completion done) = 0;
};

}  // namespace ambf::state
