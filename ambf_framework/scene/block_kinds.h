// The kinds of block that a model file may hold. Bodies, joints, cameras and lights have parsers of their own; any
// other kind is read from its rows alone and lies in Model::blocks. A program registers its kinds before it reads the
// first file; constant afterwards.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/keys.h"

namespace ambf::scene {

// What is wrong with a block although every value is fit: an error drops the block, a warning does not.
struct BlockFinding {
  bool is_error = true;
  std::string key = {}, message = {}, hint = {};
};

struct BlockKind {
  const Group* group = nullptr;
  Key list = {};                 // of the model file's header: "bodies"
  std::string_view prefix = {};  // with which blocks of the kind begin by habit: "BODY "
  bool simulated = false;        // false: known and checked, "not simulated yet"
  // Of kinds that are read from their rows alone: a description with all its defaults, whose members the rows are bound
  // to.
  std::shared_ptr<void> (*make)(const Defaults& defaults) = nullptr;
  std::vector<BlockFinding> (*check)(const void* description) = nullptr;  // may be null
};

// In the order in which a model's blocks are read.
const std::vector<const BlockKind*>& block_kinds();
// `kind` and what it points to live as long as the program.
void register_block_kind(const BlockKind& kind);

// make() of a kind whose description is a T.
template <class T>
std::shared_ptr<void> make_description(const Defaults& defaults) {
  return std::make_shared<T>(defaults.get<T>());
}

}  // namespace ambf::scene
