// Boxes around runs of nodes that follow each other in the mesh, as neighbours mostly do: one look leaves out those
// that are far from what is looked for. Private to physics/soft/. Physics thread.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "physics/soft/detail/near_shape.h"

namespace ambf::physics::detail {

struct NodeRuns {
  static constexpr std::size_t kNodes = 32, kFaces = 64;  // in a run, but for the last

  std::vector<Box> boxes;             // world, of each run of nodes; of those that are finite
  std::vector<std::uint32_t> under;   // the runs of nodes that the faces of a run have corners in
  std::vector<std::size_t> first{0};  // of each run of faces, in `under`, and the end

  void make(std::size_t nodes, const std::vector<std::array<std::uint32_t, 3>>& faces) {
    boxes.resize((nodes + kNodes - 1) / kNodes);
    std::vector<bool> is_under(boxes.size());
    for (std::size_t begin = 0; begin < faces.size(); begin += kFaces) {
      is_under.assign(boxes.size(), false);
      for (std::size_t face = begin; face < std::min(begin + kFaces, faces.size()); ++face)
        for (const std::uint32_t node : faces[face]) is_under[node / kNodes] = true;
      for (std::uint32_t run = 0; run < boxes.size(); ++run)
        if (is_under[run]) under.push_back(run);
      first.push_back(under.size());
    }
  }

  // Where nodes are now; the box around all.
  Box follow(const std::vector<btVector3>& at) {
    Box all = empty();
    for (std::size_t run = 0; run < boxes.size(); ++run) {
      Box box = empty();
      for (std::size_t i = run * kNodes; i < std::min((run + 1) * kNodes, at.size()); ++i)
        box.low.setMin(at[i]), box.high.setMax(at[i]);
      boxes[run] = box;
      all.low.setMin(box.low), all.high.setMax(box.high);
    }
    return all;
  }

  // Calls use(begin, end) with nodes among which are all that are in the box, in order.
  template <class Use>
  void each_near(const Box& box, std::size_t nodes, const Use& use) const {
    for (std::size_t run = 0; run < boxes.size(); ++run)
      if (box.overlaps(boxes[run].low, boxes[run].high)) use(run * kNodes, std::min((run + 1) * kNodes, nodes));
  }
  // Likewise with faces.
  template <class Use>
  void each_face_near(const Box& box, std::size_t faces, const Use& use) const {
    for (std::size_t run = 0; run + 1 < first.size(); ++run) {
      Box around = empty();
      for (std::size_t i = first[run]; i < first[run + 1]; ++i)
        around.low.setMin(boxes[under[i]].low), around.high.setMax(boxes[under[i]].high);
      if (box.overlaps(around.low, around.high)) use(run * kFaces, std::min((run + 1) * kFaces, faces));
    }
  }

 private:
  static Box empty() {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  }
};

}  // namespace ambf::physics::detail
