// A whole state of the simulation as plain data, and as bytes of one version. decode() trusts the bytes in nothing:
// whatever it lets pass may be put into a world without another look. Any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "math/types.h"
#include "model/effectors/saved_effectors.h"
#include "state/command.h"
#include "state/ids.h"
#include "state/structure.h"

namespace ambf::model {

// One source's command in force.
struct SavedCommand {
  std::int32_t source = 0;
  std::uint64_t order = 0;
  double age_s = 0.0;  // since its last sign of life
  state::Command command;
};

// One object's part; each kind derives its own (model/kinds/).
struct SavedObject {
  SavedObject() = default;
  virtual ~SavedObject() = default;
  SavedObject(const SavedObject&) = delete;
  SavedObject& operator=(const SavedObject&) = delete;

  std::vector<SavedCommand> commands;
};

struct SavedState {
  std::vector<std::byte> physics;  // World::save_state()
  std::uint64_t steps = 0;
  double sim_time = 0.0;  // s
  std::uint64_t last_order = 0;
  std::vector<std::vector<std::unique_ptr<SavedObject>>> objects;  // by kind and slot
  std::vector<SavedEffector> effectors;                            // by body and source
};

// An object that hangs, or is to hang, on another parent; an invalid one is the world.
struct ParentChange {
  state::ObjectId object, parent;
  std::string parent_name;  // as requested
};
// What must change in `structure` before `state` is restored.
std::vector<ParentChange> parent_changes(const SavedState& state, const state::Structure& structure);

// `state` has one entry for each object of `structure`; it stays as it is.
std::vector<std::uint8_t> encode(SavedState& state, const state::Structure& structure);

// How many of the first bytes check_head() needs.
inline constexpr std::size_t kStateHeadBytes = 24;
// Whether a file that begins so is a state that this version wrote: empty, or why not.
std::string check_head(const std::vector<std::uint8_t>& head);

// Empty when done; else what was expected where, and `out` is of no use. It must be a state of these very objects
// (whatever they hang on) in a world of steps of `step_s`.
std::string decode(const std::vector<std::uint8_t>& bytes, const state::Structure& structure, double step_s,
                   SavedState& out);

}  // namespace ambf::model
