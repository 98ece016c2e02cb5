// What all kinds have in common whose objects hang on a parent: pose commands, poses in frames, reset to where they
// were loaded, saving. A kind adds its own values: a lens, a beam, a reading.
#pragma once

#include "model/kinds/kind.h"

namespace ambf::model {

struct SavedPlaced : SavedObject {
  std::uint32_t parent_object = state::kNone;  // index into Structure::objects; kNone: the world
  std::string parent_name;                     // as requested
  math::Pose T_parent_initial, T_parent;
  bool orphaned = false;
};

class PlacedKind : public Kind {
 public:
  using Kind::Kind;

  // Poses are commanded; a kind with commands of another type overrides the three.
  bool accepts(const state::Command& command) const override;
  bool merge(LiveWorld::Impl& live, std::uint32_t slot, const CommandSlots& slots) const override;
  void transfer(StateArchive& archive, state::Command& command) const override;

  math::Pose pose(const LiveWorld::Impl& live, std::uint32_t slot) const override;
  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override;
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override;
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override;

 protected:
  // Adds an entry whose live object hangs on `parent`, or at T_parent in the model's frame. Null when no more objects
  // are accepted.
  Entry* add(Catalogue::Impl& all, std::unique_ptr<LivePlaced> live, const scene::Identity& identity,
             const std::string& parent, math::Pose T_parent, const LoadedModel& model, const LoadOptions& options,
             Findings& findings) const;
  // Object and parent of the row of a new structure.
  static void set_placed(state::PlacedInfo& row, const Entry& entry, const StructureDraft& draft);
  LivePlaced& placed(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LivePlaced&>(*live.tables.of(number())[slot]);
  }
};

template <class Described>
void erase_block(std::vector<Described>& blocks, const std::string& identifier) {
  std::erase_if(blocks, [&](const Described& block) { return block.identity.identifier == identifier; });
}

}  // namespace ambf::model
