// Private to mesh/: just enough XML to read COLLADA, safe on any bytes: no entities beyond the five of XML, no
// external anything, limits on depth and size, no recursion. The tree refers to the text it was parsed from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ambf::mesh {

class XmlTree {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  struct Node {
    std::string_view name;     // without namespace prefix; empty: a piece of text
    std::string_view content;  // attributes as written; or the text
    std::uint32_t first_child = kNone, next_sibling = kNone;
    int line = 0;
  };

  // False with a sentence and a line when the text is not well-formed or beyond the limits.
  bool parse(std::string_view text, std::string& out_error, int& out_line);

  const Node& operator[](std::uint32_t node) const { return nodes_[node]; }
  std::uint32_t root() const { return root_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  // First child of that name (kNone when none, also for node kNone); the next sibling of the same name as `node`.
  std::uint32_t child(std::uint32_t node, std::string_view name) const;
  std::uint32_t next_same(std::uint32_t node) const;
  // Decoded; empty when absent.
  std::string attribute(std::uint32_t node, std::string_view name) const;
  // The node's own text, decoded and trimmed (comments within are skipped).
  std::string text(std::uint32_t node) const;
  // The same undecoded, piece by piece: for long lists of numbers.
  template <typename Visit>
  void each_text(std::uint32_t node, const Visit& visit) const {
    if (node == kNone) return;
    for (std::uint32_t c = nodes_[node].first_child; c != kNone; c = nodes_[c].next_sibling) {
      if (nodes_[c].name.empty()) visit(nodes_[c].content);
    }
  }

 private:
  std::vector<Node> nodes_;
  std::uint32_t root_ = kNone;
};

}  // namespace ambf::mesh
