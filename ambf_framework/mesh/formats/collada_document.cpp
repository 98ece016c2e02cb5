#include "mesh/formats/detail/collada_document.h"

#include <algorithm>
#include <cstring>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

// Each '<' may become a node and each '=' an attribute, of about 100 bytes: both limits together hold a document below
// 0.5 GiB.
constexpr std::ptrdiff_t kMaxMarks = 2'000'000;

std::string_view without_prefix(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// All elements in the order of the document, without recursion: files may nest as deep as they are long.
template <typename Visit>
void each_element(const pugi::xml_node& root, const Visit& visit) {
  pugi::xml_node node = root;
  while (node) {
    if (node.type() == pugi::node_element) visit(node);
    if (pugi::xml_node down = node.first_child()) {
      node = down;
      continue;
    }
    while (node != root && !node.next_sibling()) node = node.parent();
    node = node == root ? pugi::xml_node() : node.next_sibling();
  }
}

}  // namespace

bool ColladaDocument::parse(std::string_view text, std::string& out_error, int& out_line) {
  out_line = 0;
  if (std::count(text.begin(), text.end(), '<') > kMaxMarks || std::count(text.begin(), text.end(), '=') > kMaxMarks) {
    out_error = "there are more than 2000000 elements or attributes";
    return false;
  }
  line_ends_.clear();
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    line_ends_.push_back(at);
  const pugi::xml_parse_result result =
      document_.load_buffer(text.data(), text.size(), pugi::parse_cdata | pugi::parse_escapes, pugi::encoding_utf8);
  const auto line_at = [this](std::ptrdiff_t offset) {
    const auto end = std::lower_bound(line_ends_.begin(), line_ends_.end(), static_cast<std::size_t>(offset));
    return static_cast<int>(end - line_ends_.begin()) + 1;
  };
  if (!result) {
    out_error = result.description();
    out_line = line_at(result.offset);
    return false;
  }
  by_id_.clear();
  each_element(root(), [this](const Node& node) {
    if (const pugi::xml_attribute id = node.attribute("id"); *id.value() != '\0') by_id_.emplace(id.value(), node);
  });
  return true;
}

ColladaDocument::Node ColladaDocument::find(const std::string& reference, std::string_view name) const {
  const std::string_view id =
      std::string_view(reference).substr(!reference.empty() && reference.front() == '#' ? 1 : 0);
  const auto found = by_id_.find(id);
  return found != by_id_.end() && ColladaDocument::name(found->second) == name ? found->second : Node();
}

int ColladaDocument::line(const Node& node) const {
  if (!node) return 0;
  const auto end =
      std::lower_bound(line_ends_.begin(), line_ends_.end(), static_cast<std::size_t>(node.offset_debug()));
  return static_cast<int>(end - line_ends_.begin()) + 1;
}

std::string_view ColladaDocument::name(const Node& node) { return without_prefix(node.name()); }

ColladaDocument::Node ColladaDocument::child(const Node& node, std::string_view name) {
  Node c = node.first_child();
  while (c && ColladaDocument::name(c) != name) c = c.next_sibling();
  return c;
}

ColladaDocument::Node ColladaDocument::next_same(const Node& node) {
  Node c = node.next_sibling();
  while (c && name(c) != name(node)) c = c.next_sibling();
  return c;
}

std::string ColladaDocument::attribute(const Node& node, const char* name) { return node.attribute(name).value(); }

std::size_t ColladaDocument::length(const Node& node) {
  std::size_t sum = std::strlen(node.value());
  for (const pugi::xml_attribute& attribute : node.attributes())
    sum += std::strlen(attribute.name()) + std::strlen(attribute.value());
  return sum;
}

std::string ColladaDocument::text(const Node& node) {
  std::string all;
  each_text(node, [&all](std::string_view piece) { all += piece; });
  return std::string(trim(all));
}

}  // namespace ambf::mesh
