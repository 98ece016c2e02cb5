// The ability to change what exists: load, unload, remove, reparent. The loader thread does it; nothing waits for it or
// for the physics thread. Any thread. C++17.
#pragma once

#include <string>

#include "math/types.h"
#include "state/abilities/outcome.h"
#include "state/ids.h"

namespace ambf::state {

struct LoadRequest {
  std::string path;          // ADF file; or
  std::string text;          // ADF text (paths in it are relative to `path`, or to the working directory)
  std::string name_prefix;   // put before the model's namespaces
  math::Pose T_world_model;  // where to place the model
  bool check_only = false;   // parse and report, load nothing
};

class EditAbility {
 public:
  virtual ~EditAbility() = default;
  virtual void load(LoadRequest request, Completion done) = 0;
  virtual void unload(const std::string& model, Completion done) = 0;
  virtual void remove(const std::string& object, Completion done) = 0;
  // Attaches a camera or a light to the object named `parent` (rules of the ADF key; empty: the world), keeping its
  // pose in the world. A world reset restores the loaded parent.
  virtual void set_parent(ObjectId object, const std::string& parent, Completion done) = 0;
};

}  // namespace ambf::state
