// Who descends from whom: every body knows all its descendants, the joints below it and all its ancestors (dissertation
// §4.3.2, Alg. 1 mended: a new joint joins everything above it to everything below it). Any graph: trees, closed loops,
// directed cycles. Bodies and joints are the caller's numbers. Pure data, no thread of its own; the catalogue owns one.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace ambf::model {

class Lineage {
 public:
  // Joints must have distinct numbers; parent != child.
  void add(std::uint32_t joint, std::uint32_t parent, std::uint32_t child);

  // Takes joints away, and those of the bodies taken away; all lineages are rebuilt from the remaining joints in load
  // order.
  void remove(const std::vector<std::uint32_t>& joints, const std::vector<std::uint32_t>& bodies);

  // All bodies below `body`, in the reference's order: for each joint added, the child's descendants first, then the
  // child. A body is not its own descendant, also within a directed cycle.
  const std::vector<std::uint32_t>& descendants(std::uint32_t body) const;

  // All joints below `body`: first the one by which each descendant was found, in the order of descendants(); after
  // them those that close a loop to a descendant already known, in the order in which they came.
  std::vector<std::uint32_t> joints(std::uint32_t body) const;

  // All bodies above `body`, in the order in which they became known.
  const std::vector<std::uint32_t>& ancestors(std::uint32_t body) const;

 private:
  struct Link {
    std::uint32_t joint, parent, child;
  };
  struct Node {
    std::vector<std::uint32_t> descendants;
    std::vector<std::uint32_t> found_by;  // joint of each descendant
    std::vector<std::uint32_t> closing;   // joints to descendants already known
    std::vector<std::uint32_t> ancestors;
    std::unordered_set<std::uint32_t> known_descendants, known_joints, known_ancestors;
  };
  void connect(const Link& link);
  static void list_joint(Node& above, std::uint32_t above_body, std::uint32_t child, std::uint32_t joint);

  std::vector<Link> links_;  // in load order
  std::unordered_map<std::uint32_t, Node> nodes_;
};

}  // namespace ambf::model
