// What the loader hands to the physics thread: a structural change prepared to the last piece, and what comes back to
// be freed. Made by Catalogue (loader thread), consumed once by LiveWorld::apply (physics thread), in the order in
// which they were made.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/limits.h"
#include "state/frame.h"
#include "state/structure.h"

namespace ambf::model {

struct Swap;  // model/detail/swap.h: live objects to link and unlink

// Move only.
struct Prepared {
  bool success = false;                               // false: nothing to apply; the catalogue is as before
  base::Diagnostics diagnostics;                      // findings of the load; also of a success
  std::string model;                                  // ModelInfo::name of what was loaded
  std::shared_ptr<const state::Structure> structure;  // the new one
  std::vector<std::unique_ptr<state::Frame>> frames;  // CatalogueOptions::frames of them, sized for it
  std::unique_ptr<Swap> swap;

  Prepared();
  Prepared(Prepared&&) noexcept;
  Prepared& operator=(Prepared&&) noexcept;
  ~Prepared();
};

// What a swap replaced: old live objects, shapes, tables. The physics thread passes it to the loader, which lets it go.
struct Garbage {
  std::unique_ptr<Swap> replaced;

  Garbage();
  Garbage(Garbage&&) noexcept;
  Garbage& operator=(Garbage&&) noexcept;
  ~Garbage();
};

}  // namespace ambf::model
