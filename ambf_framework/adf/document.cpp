#include "adf/document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <unordered_map>
#include <unordered_set>

namespace ambf::adf {

struct DocumentChild {
  std::uint32_t node = 0;
  Mark mark;
};

// Small, for files have up to a million.
struct DocumentNode {
  Value::Kind kind = Value::Kind::null;
  bool anchored = false;
  bool open = false;                  // list or map that is still being read
  std::uint8_t depth = 1;             // of the tree below, aliases followed
  std::uint32_t child_count = 0;      // of a map: keys and values in turn
  std::uint32_t first_child = 0;      // in DocumentData::children
  std::uint32_t expanded = 1;         // nodes below, aliases written out
  const std::string* text = nullptr;  // of a scalar
};
static_assert(limits::kDepth < 255 && 2 * limits::kExpandedNodes < (1ull << 32));

struct DocumentData {
  std::vector<DocumentNode> nodes;
  std::vector<DocumentChild> children;
  std::unordered_set<std::string> texts;  // each once: keys are as many as blocks
};

namespace {

Mark to_mark(const YAML::Mark& mark) {
  if (mark.is_null()) return {};
  return {mark.line + 1, mark.column + 1};
}

struct LimitExceeded {
  DocumentError error;
};

// Builds the tree from yaml-cpp's events. (Its own Node does not know where an alias stands and follows cyclic ones for
// ever.)
class TreeBuilder final : public YAML::EventHandler {
 public:
  explicit TreeBuilder(DocumentData& data) : data_(data) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { close(open(Value::Kind::null, mark, anchor)); }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const Mark at = to_mark(mark);
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      throw LimitExceeded{{"an alias of an unknown anchor", "define the anchor before its use", at}};
    if (data_.nodes[found->second].open) {
      throw LimitExceeded{{"an alias stands inside of what it names, which would never end", "break the circle", at}};
    }
    attach(found->second, at);
  }

  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor, const std::string& text) override {
    const std::uint32_t node = open(Value::Kind::scalar, mark, anchor);
    data_.nodes[node].text = &*data_.texts.insert(text).first;
    close(node);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    push(open(Value::Kind::list, mark, anchor));
  }
  void OnSequenceEnd() override { pop(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    push(open(Value::Kind::map, mark, anchor));
  }
  void OnMapEnd() override { pop(); }

  std::optional<DocumentChild> root() const { return root_; }

 private:
  std::uint32_t open(Value::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    const Mark at = to_mark(mark);
    if (data_.nodes.size() >= limits::kNodes) {
      throw LimitExceeded{
          {"more than " + std::to_string(limits::kNodes) + " values in one file", "split the file", at}};
    }
    if (stack_.size() >= static_cast<std::size_t>(limits::kDepth)) throw LimitExceeded{too_deep(at)};
    const auto index = static_cast<std::uint32_t>(data_.nodes.size());
    DocumentNode node;
    node.kind = kind;
    node.open = true;
    node.anchored = anchor != 0;
    data_.nodes.push_back(node);
    if (anchor != 0) anchors_[anchor] = index;
    marks_.push_back(at);
    return index;
  }

  void push(std::uint32_t node) { stack_.push_back({node, pending_.size()}); }

  void pop() {
    const OpenNode ended = stack_.back();
    stack_.pop_back();
    DocumentNode& node = data_.nodes[ended.node];
    const auto first = pending_.begin() + static_cast<std::ptrdiff_t>(ended.first_pending);
    node.first_child = static_cast<std::uint32_t>(data_.children.size());
    node.child_count = static_cast<std::uint32_t>(pending_.end() - first);
    data_.children.insert(data_.children.end(), first, pending_.end());
    pending_.erase(first, pending_.end());
    close(ended.node);
  }

  void close(std::uint32_t index) {
    data_.nodes[index].open = false;
    attach(index, marks_.back());
    marks_.pop_back();
  }

  void attach(std::uint32_t index, Mark at) {
    if (stack_.empty()) {
      root_ = DocumentChild{index, at};
      return;
    }
    DocumentNode& parent = data_.nodes[stack_.back().node];
    const DocumentNode& child = data_.nodes[index];
    parent.depth = std::max(parent.depth, static_cast<std::uint8_t>(child.depth + 1));
    parent.expanded += child.expanded;
    if (parent.depth > limits::kDepth) throw LimitExceeded{too_deep(at)};
    if (parent.expanded > limits::kExpandedNodes) {
      throw LimitExceeded{{"aliases expand to more than " + std::to_string(limits::kExpandedNodes) + " values",
                           "nest aliases less", at}};
    }
    pending_.push_back({index, at});
  }

  static DocumentError too_deep(Mark at) {
    return {"values nest deeper than " + std::to_string(limits::kDepth) + " levels", "flatten the file", at};
  }

  DocumentData& data_;
  struct OpenNode {
    std::uint32_t node;
    std::size_t first_pending;  // of its children
  };
  std::vector<OpenNode> stack_;         // open lists and maps
  std::vector<DocumentChild> pending_;  // children of these
  std::vector<Mark> marks_;             // of all open nodes
  std::unordered_map<YAML::anchor_t, std::uint32_t> anchors_;
  std::optional<DocumentChild> root_;
};

// yaml-cpp keeps all tokens of a flow collection (260 bytes each) until its end has been seen: what could be one is
// counted before.
bool too_many_tokens(const std::string& text) {
  static constexpr std::string_view kTokens = "[]{},:?&*!";
  const auto is_token = [](char c) { return kTokens.find(c) != std::string_view::npos; };
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_token)) > limits::kIndicators;
}

const DocumentNode kNullNode;
const std::string kNoText;

const DocumentNode& node_at(const DocumentData* data, std::uint32_t index) {
  return data ? data->nodes[index] : kNullNode;
}

}  // namespace

Value::Kind Value::kind() const { return node_at(data_, index_).kind; }
bool Value::anchored() const { return node_at(data_, index_).anchored; }
bool Value::holds_anchors() const {
  const DocumentNode& node = node_at(data_, index_);
  for (std::uint32_t i = 0; i < node.child_count && !node.anchored; ++i) {
    if (item(i).holds_anchors()) return true;
  }
  return node.anchored;
}

std::uint64_t Value::expanded() const { return node_at(data_, index_).expanded; }

const std::string& Value::text() const {
  const std::string* text = node_at(data_, index_).text;
  return text != nullptr ? *text : kNoText;
}

std::size_t Value::size() const {
  const DocumentNode& node = node_at(data_, index_);
  return node.kind == Kind::map ? node.child_count / 2 : node.child_count;
}

Value Value::item(std::size_t index) const {
  const DocumentChild& child = data_->children[data_->nodes[index_].first_child + index];
  return {data_, child.node, child.mark};
}

Value::Entry Value::entry(std::size_t index) const { return {item(2 * index), item(2 * index + 1)}; }

std::optional<Value> Value::find(std::string_view key) const {
  if (!is_map()) return std::nullopt;
  for (std::size_t i = 0; i < size(); ++i) {
    const Value name = item(2 * i);
    if (!name.is_scalar() || name.text() != key) continue;
    const Value value = item(2 * i + 1);
    if (value.is_absent()) return std::nullopt;
    return value;
  }
  return std::nullopt;
}

Document::Document(const std::string& text) : data_(std::make_unique<DocumentData>()) {
  if (text.size() > limits::kFileBytes) {
    error_ = DocumentError{
        "the file is larger than " + std::to_string(limits::kFileBytes >> 20) + " MiB", "split the file", {}};
    return;
  }
  if (too_many_tokens(text)) {
    error_ =
        DocumentError{"more than " + std::to_string(limits::kIndicators) + " brackets, commas and colons in one file",
                      "split the file",
                      {}};
    return;
  }
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    TreeBuilder builder(*data_);
    const bool any = parser.HandleNextDocument(builder);
    if (!any || !builder.root()) {
      error_ = DocumentError{"the file is empty", "", {}};
      return;
    }
    const DocumentChild root = *builder.root();
    // The root is kept last, so that root() needs no index of its own.
    DocumentNode holder;
    holder.kind = Value::Kind::list;
    holder.first_child = static_cast<std::uint32_t>(data_->children.size());
    holder.child_count = 1;
    data_->children.push_back(root);
    data_->nodes.push_back(holder);
    try {
      has_more_documents_ = static_cast<bool>(parser);
    } catch (const YAML::Exception&) {
      has_more_documents_ = true;  // what follows is not even YAML; it does not count
    }
  } catch (const LimitExceeded& limit) {
    error_ = limit.error;
  } catch (const YAML::Exception& exception) {
    error_ = DocumentError{"YAML syntax error: " + exception.msg,
                           "compare brackets, quotes and indentation here and just above", to_mark(exception.mark)};
  } catch (const std::exception& exception) {
    error_ = DocumentError{std::string("cannot be read as YAML: ") + exception.what(), "", {}};
  }
}

Document::~Document() = default;
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;

Value Document::root() const {
  if (error_ || data_->nodes.empty()) return {};
  const Value holder{data_.get(), static_cast<std::uint32_t>(data_->nodes.size() - 1), {}};
  return holder.item(0);
}

}  // namespace ambf::adf
