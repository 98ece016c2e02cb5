// Who descends from whom: every body knows all its descendants, the joints below it and all its ancestors (dissertation
// §4.3.2, Alg. 1 mended: a new joint joins everything above it to everything below it). Any graph: trees, closed loops,
// directed cycles. Bodies and joints are the caller's numbers. Pure data, no thread of its own; the catalogue owns one.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace ambf::model {

class Lineage {
 public:
  // Joints must have distinct numbers; parent != child.
  void add(std::uint32_t joint, std::uint32_t parent, std::uint32_t child);

  // Takes joints away, and those of the bodies taken away; all lineages follow from the remaining joints in load order.
  void remove(const std::vector<std::uint32_t>& joints, const std::vector<std::uint32_t>& bodies);

  // All bodies below `body`, in the reference's order: for each joint added, the child's descendants first, then the
  // child. A body is not its own descendant, also within a directed cycle.
  std::vector<std::uint32_t> descendants(std::uint32_t body) const;

  // All joints below `body`: first the one by which each descendant was found, in the order of descendants(); after
  // them those that close a loop to a descendant already known, in the order in which they came.
  std::vector<std::uint32_t> joints(std::uint32_t body) const;

  // All bodies above `body`, the nearest first.
  std::vector<std::uint32_t> ancestors(std::uint32_t body) const;

  struct Link {
    std::uint32_t joint, parent, child;
  };
  const std::vector<Link>& links() const { return links_; }  // in load order

 private:
  std::vector<Link> links_;
};

// What hangs below each body of a Lineage, which must outlive it and stay as it is. Storage grows with the number of
// links, and lists are made one at a time as they are asked for; only where mechanisms close loops do all bodies of a
// mechanism keep theirs.
class Descent {
 public:
  explicit Descent(const Lineage& lineage);
  ~Descent();
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;

  struct Below {
    std::vector<std::uint32_t> bodies;
    std::vector<std::uint32_t> joints;  // the first ones found the bodies, the rest close loops
  };
  Below below(std::uint32_t body) const;

  // Every body that has joints, each after one of its parents (in directed cycles: after one where there is one).
  struct Placed {
    std::uint32_t body;
    std::uint32_t parent;  // that comes before it; the body itself where there is none
  };
  std::vector<Placed> from_the_roots() const;

 private:
  struct Node;
  struct Mechanism;  // with loops
  std::uint32_t node_of(std::uint32_t body);
  void find_loops();
  void find_times();
  Below below_in_tree(std::uint32_t node) const;

  const std::vector<Lineage::Link>& links_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;  // body -> node
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> children_;  // node of each link's child
  std::vector<std::unique_ptr<Mechanism>> mechanisms_;
};

}  // namespace ambf::model
