// Private to mesh/: a COLLADA file as elements, parsed by pugixml, which expands no entities beyond those of XML itself
// and reads nothing but the bytes it is given. Names are compared without their namespace prefix. Immutable after
// parse(); one thread.
#pragma once

#include <cstddef>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ambf::mesh {

class ColladaDocument {
 public:
  using Node = pugi::xml_node;  // an element; null: there is none, which every function here takes and finds nothing in

  // False with a sentence and a line when the text is not well-formed or too large.
  bool parse(std::string_view text, std::string& out_error, int& out_line);

  Node root() const { return document_.document_element(); }
  // The element `name` that a reference like "#id" means (the '#' may be missing). Of equal ids the first counts.
  Node find(const std::string& reference, std::string_view name) const;
  int line(const Node& node) const;  // of its first letter; 0 for null

  static std::string_view name(const Node& node);
  // First child element of that name; the next sibling of the same name as `node`.
  static Node child(const Node& node, std::string_view name);
  static Node next_same(const Node& node);
  static std::string attribute(const Node& node, const char* name);  // empty when absent
  // Characters of all attributes, or of a piece of text: what it costs to read the node.
  static std::size_t length(const Node& node);
  // The node's own text, trimmed; comments within are skipped.
  static std::string text(const Node& node);
  // The same piece by piece, as comments divide it: for long lists of numbers.
  template <typename Visit>
  static void each_text(const Node& node, const Visit& visit) {
    for (const Node& piece : node.children()) {
      if (piece.type() == pugi::node_pcdata || piece.type() == pugi::node_cdata) visit(std::string_view(piece.value()));
    }
  }

 private:
  pugi::xml_document document_;
  std::vector<std::size_t> line_ends_;  // offsets in the text
  std::map<std::string, Node, std::less<>> by_id_;
};

}  // namespace ambf::mesh
