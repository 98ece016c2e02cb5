#include "mesh/formats/detail/xml.h"

#include <algorithm>
#include <cstring>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

constexpr std::size_t kMostNodes = 2'000'000;
constexpr std::size_t kDeepest = 200;

bool is_blank(std::string_view text) { return trim(text).empty(); }

std::string_view without_prefix(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    static constexpr struct {
      std::string_view code;
      char character;
    } kEntities[] = {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};
    char character = text[i];
    std::size_t length = 1;
    for (const auto& entity : kEntities) {
      if (text.substr(i, entity.code.size()) == entity.code) {
        character = entity.character;
        length = entity.code.size();
      }
    }
    out += character;
    i += length - 1;
  }
  return out;
}

class Parser {
 public:
  Parser(std::string_view text, std::vector<XmlTree::Node>& nodes) : text_(text), nodes_(nodes) {}

  // False with error_ set.
  bool run(std::uint32_t& root) {
    nodes_.push_back({"#document", {}, XmlTree::kNone, XmlTree::kNone, 1});
    open_.push_back({0, XmlTree::kNone});
    while (at_ < text_.size()) {
      const bool ok = text_[at_] == '<' ? read_markup() : read_text();
      if (!ok) return false;
    }
    if (open_.size() > 1) return fail("element " + in_quotes(nodes_[open_.back().node].name) + " has no end");
    for (std::uint32_t c = nodes_[0].first_child; c != XmlTree::kNone; c = nodes_[c].next_sibling) {
      if (!nodes_[c].name.empty()) root = c;
    }
    return root != XmlTree::kNone || fail("there is no element");
  }

  std::string error;
  int line = 1;

 private:
  struct Open {
    std::uint32_t node, last_child;
  };

  bool fail(const std::string& what) {
    error = what;
    return false;
  }

  void advance_to(std::size_t end) {
    line += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                        text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at_ = end;
  }

  bool skip_behind(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) return fail("expected " + in_quotes(end) + " before the end of the file");
    advance_to(found + end.size());
    return true;
  }

  bool add(std::string_view name, std::string_view content) {
    if (nodes_.size() >= kMostNodes) return fail("there are more than 2000000 elements");
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({name, content, XmlTree::kNone, XmlTree::kNone, line});
    Open& parent = open_.back();
    (parent.last_child == XmlTree::kNone ? nodes_[parent.node].first_child : nodes_[parent.last_child].next_sibling) =
        index;
    parent.last_child = index;
    return true;
  }

  bool read_text() {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    const std::string_view content = text_.substr(at_, end - at_);
    if (!is_blank(content) && open_.size() > 1 && !add({}, content)) return false;
    advance_to(end);
    return true;
  }

  bool read_markup() {
    const std::string_view rest = text_.substr(at_);
    if (rest.substr(0, 4) == "<!--") return skip_behind("-->");
    if (rest.substr(0, 2) == "<?") return skip_behind("?>");
    if (rest.substr(0, 9) == "<![CDATA[") {
      const std::size_t begin = at_ + 9;
      if (!skip_behind("]]>")) return false;
      return open_.size() == 1 || add({}, text_.substr(begin, at_ - 3 - begin));
    }
    if (rest.substr(0, 2) == "<!") return skip_declaration();
    return read_tag();
  }

  // <!DOCTYPE ... [ ... ]>: nothing in it is used, entities least of all.
  bool skip_declaration() {
    int depth = 0;
    for (std::size_t i = at_; i < text_.size(); ++i) {
      depth += text_[i] == '<' ? 1 : (text_[i] == '>' ? -1 : 0);
      if (depth == 0) {
        advance_to(i + 1);
        return true;
      }
    }
    return fail("expected '>' before the end of the file");
  }

  bool read_tag() {
    // The end of the tag is the first '>' outside quotes.
    char quote = '\0';
    std::size_t end = at_ + 1;
    for (; end < text_.size() && (quote != '\0' || text_[end] != '>'); ++end) {
      const char c = text_[end];
      if (quote == '\0' && (c == '"' || c == '\'')) {
        quote = c;
      } else if (c == quote) {
        quote = '\0';
      }
    }
    if (end >= text_.size()) return fail("a tag is cut short");
    std::string_view inside = text_.substr(at_ + 1, end - at_ - 1);
    const bool closing = !inside.empty() && inside.front() == '/';
    const bool empty = !closing && !inside.empty() && inside.back() == '/';
    if (closing) inside.remove_prefix(1);
    if (empty) inside.remove_suffix(1);
    std::size_t length = 0;
    while (length < inside.size() && !is_space(inside[length]) && inside[length] != '\n') ++length;
    const std::string_view name = without_prefix(inside.substr(0, length));
    if (name.empty()) return fail("a tag has no name");
    if (closing) {
      if (open_.size() < 2 || nodes_[open_.back().node].name != name) {
        return fail("found the end of " + in_quotes(name) + ", expected that of " +
                    (open_.size() < 2 ? "none" : in_quotes(nodes_[open_.back().node].name)));
      }
      open_.pop_back();
    } else {
      if (!add(name, inside.substr(length))) return false;
      if (!empty) {
        if (open_.size() > kDeepest) return fail("elements are nested deeper than 200");
        open_.push_back({open_.back().last_child, XmlTree::kNone});
      }
    }
    advance_to(end + 1);
    return true;
  }

  std::string_view text_;
  std::vector<XmlTree::Node>& nodes_;
  std::vector<Open> open_;
  std::size_t at_ = 0;
};

}  // namespace

bool XmlTree::parse(std::string_view text, std::string& out_error, int& out_line) {
  nodes_.clear();
  root_ = kNone;
  Parser parser(text, nodes_);
  const bool ok = parser.run(root_);
  out_error = parser.error;
  out_line = parser.line;
  return ok;
}

std::uint32_t XmlTree::child(std::uint32_t node, std::string_view name) const {
  if (node == kNone) return kNone;
  std::uint32_t c = nodes_[node].first_child;
  while (c != kNone && nodes_[c].name != name) c = nodes_[c].next_sibling;
  return c;
}

std::uint32_t XmlTree::next_same(std::uint32_t node) const {
  if (node == kNone) return kNone;
  std::uint32_t c = nodes_[node].next_sibling;
  while (c != kNone && nodes_[c].name != nodes_[node].name) c = nodes_[c].next_sibling;
  return c;
}

std::string XmlTree::attribute(std::uint32_t node, std::string_view name) const {
  if (node == kNone) return {};
  std::string_view rest = nodes_[node].content;
  while (true) {
    rest = trim(rest);
    const std::size_t equals = rest.find('=');
    if (equals == std::string_view::npos) return {};
    const std::string_view found = trim(rest.substr(0, equals));
    rest = trim(rest.substr(equals + 1));
    if (rest.empty() || (rest.front() != '"' && rest.front() != '\'')) return {};
    const std::size_t end = rest.find(rest.front(), 1);
    if (end == std::string_view::npos) return {};
    if (found == name) return decoded(rest.substr(1, end - 1));
    rest.remove_prefix(end + 1);
  }
}

std::string XmlTree::text(std::uint32_t node) const {
  std::string all;
  each_text(node, [&all](std::string_view piece) { all += piece; });
  return decoded(trim(all));
}

}  // namespace ambf::mesh
