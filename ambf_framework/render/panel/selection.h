// The object that the panel shows in full, and the tree that it is chosen from. Main thread.
#pragma once

#include "render/panel/object_tree.h"
#include "state/structure.h"

namespace ambf::render {

class Selection {
 public:
  // Once a picture; the structure stays valid until the next call.
  void observe(const state::Structure& structure);

  state::ObjectId id() const { return id_; }
  const state::ObjectInfo* info() const;  // null: nothing, or gone
  void select(state::ObjectId object);
  void select_parent();

  ObjectTree tree;

 private:
  const state::Structure* structure_ = nullptr;
  state::ObjectId id_;
};

}  // namespace ambf::render
