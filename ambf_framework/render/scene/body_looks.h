// How one window shows single bodies: hidden, as a wireframe, see-through. For its user alone: published pictures
// show none of it, and physics knows nothing of it. Pure data. Main thread.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "state/structure.h"

namespace ambf::render {

struct BodyLook {
  bool hidden = false;
  bool wireframe = false;  // edges instead of faces
  float opacity = 1.0F;    // times what its materials have
  bool operator==(const BodyLook&) const = default;
  bool has_faces() const { return !hidden && !wireframe; }
};

class BodyLooks {
 public:
  BodyLook of(state::ObjectId body) const;
  void set(state::ObjectId body, const BodyLook& look);
  void clear() { looks_.clear(); }
  bool any() const { return !looks_.empty(); }

  // By slot, soft bodies behind bodies (DrawInstance::body); empty while nothing differs from what was loaded.
  // `no_visuals`: no body has faces.
  std::vector<BodyLook> by_slot(const state::Structure& structure, bool no_visuals = false) const;

 private:
  std::map<std::uint64_t, BodyLook> looks_;  // by id: what is loaded in the place of something else looks as loaded
};

// Of a body by its slot, from such a list.
inline BodyLook look_of(const std::vector<BodyLook>& looks, std::size_t slot) {
  return slot < looks.size() ? looks[slot] : BodyLook{};
}

}  // namespace ambf::render
