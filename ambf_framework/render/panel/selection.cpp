#include "render/panel/selection.h"

#include "render/panel/relations.h"

namespace ambf::render {

void Selection::observe(const state::Structure& structure) {
  structure_ = &structure;
  if (id_.valid() && state::find(structure, id_) == state::kNone) id_ = {};
}

const state::ObjectInfo* Selection::info() const {
  if (structure_ == nullptr) return nullptr;
  const std::uint32_t object = state::find(*structure_, id_);
  return object == state::kNone ? nullptr : &structure_->objects[object];
}

void Selection::select(state::ObjectId object) {
  if (object == id_) return;
  id_ = object;
  tree.reveal(object);
}

void Selection::select_parent() {
  if (structure_ != nullptr) select(parent_of(*structure_, id_));
}

}  // namespace ambf::render
