// What all kinds have in common whose objects hang on a parent: pose commands, poses in frames, reset to where they
// were loaded, saving. A kind adds its own values: a lens, a beam, a reading.
#pragma once

#include <any>
#include <memory>
#include <string>
#include <utility>

#include "model/kinds/kind.h"
#include "scene/block_kinds.h"

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

// A kind whose ADF blocks are read from their rows alone (scene/block_kinds.h) into a Described, which has a member
// `parent`.
template <class Described>
class DescribedKind : public PlacedKind {
 public:
  // `blocks` lives as long as the program.
  DescribedKind(state::ObjectKind number, const scene::BlockKind& blocks) : PlacedKind(number), blocks_(blocks) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const final {
    each_block(model.description, [&](const scene::KindBlock& block) {
      const Described& described = block.as<Described>();
      Made made = make(described);
      Entry* entry =
          add(all, std::move(made.live), block.identity, described.parent, made.T_parent, model, options, findings);
      if (entry != nullptr) entry->row = std::move(made.row);
    });
  }
  void erase_block(scene::Model& model, const std::string& identifier) const final {
    std::erase_if(model.blocks, [&](const scene::KindBlock& block) {
      return block.kind == &blocks_ && block.identity.identifier == identifier;
    });
  }
  void each_parent(const scene::Model& model, const ParentVisit& visit) const final {
    each_block(model, [&](const scene::KindBlock& block) { visit(block.identity, block.as<Described>().parent); });
  }

 protected:
  struct Made {
    std::unique_ptr<LivePlaced> live;
    std::any row;         // of structures, less object and parent
    math::Pose T_parent;  // as loaded; in the model's frame where the block names no parent
  };
  // The live object that a block describes.
  virtual Made make(const Described& described) const = 0;

 private:
  template <class Visit>
  void each_block(const scene::Model& model, Visit visit) const {
    for (const scene::KindBlock& block : model.blocks)
      if (block.kind == &blocks_) visit(block);
  }

  const scene::BlockKind& blocks_;
};

template <class Described>
void erase_block(std::vector<Described>& blocks, const std::string& identifier) {
  std::erase_if(blocks, [&](const Described& block) { return block.identity.identifier == identifier; });
}

}  // namespace ambf::model
