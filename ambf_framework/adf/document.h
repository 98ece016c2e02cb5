// YAML text as a tree of ours with a line and column for every value, within limits on size, depth and alias expansion,
// so that the rest of adf/ never meets yaml-cpp, its exceptions or a cyclic alias. Immutable once read; any thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ambf::adf {

// 1-based; 0 where unknown.
struct Mark {
  int line = 0, column = 0;
};

namespace limits {
constexpr std::size_t kFileBytes = 8u << 20;
constexpr std::size_t kIndicators = 1'500'000;       // brackets, commas, colons, .. in the text
constexpr std::size_t kNodes = 1'000'000;            // written in the file
constexpr std::uint64_t kExpandedNodes = 2'000'000;  // with every alias written out
constexpr int kDepth = 64;
constexpr std::size_t kListedBlocks = 10'000;     // in one header list
constexpr std::size_t kDiagnostics = 1000;        // shown of one file
constexpr std::size_t kHintCandidates = 100'000;  // words that hints of one file are sought among
}  // namespace limits

struct DocumentNode;
struct DocumentData;

// A handle to one value; valid while its Document lives.
class Value {
 public:
  enum class Kind { null, scalar, list, map };
  struct Entry;

  Value() = default;
  Kind kind() const;
  bool is_null() const { return kind() == Kind::null; }
  bool is_scalar() const { return kind() == Kind::scalar; }
  bool is_list() const { return kind() == Kind::list; }
  bool is_map() const { return kind() == Kind::map; }
  // Null or an empty text: as if the key were not there.
  bool is_absent() const { return is_null() || (is_scalar() && text().empty()); }
  // Where it is written; for an alias, where the alias stands.
  Mark mark() const { return mark_; }
  // The same for an anchor and its aliases, and for nothing else.
  std::uint32_t id() const { return index_; }
  bool anchored() const;                 // has an anchor, or is an alias
  bool holds_anchors() const;            // is anchored itself, or something in it is
  const std::string& text() const;       // of a scalar
  std::size_t size() const;              // items or entries
  std::uint64_t expanded() const;        // values in it, aliases written out
  Value item(std::size_t index) const;   // of a list
  Entry entry(std::size_t index) const;  // of a map, in the order of the file, duplicates and all
  // The first value with this key; none when there is none or it is absent.
  std::optional<Value> find(std::string_view key) const;

 private:
  friend class Document;
  Value(const DocumentData* data, std::uint32_t index, Mark mark) : data_(data), index_(index), mark_(mark) {}
  const DocumentData* data_ = nullptr;
  std::uint32_t index_ = 0;
  Mark mark_;
};

struct Value::Entry {
  Value key, value;
};

struct DocumentError {
  std::string message, hint;
  Mark mark;
};

class Document {
 public:
  // Reads the first document of the text. On failure root() is null and error() says why.
  explicit Document(const std::string& text);
  ~Document();
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;

  Value root() const;
  const std::optional<DocumentError>& error() const { return error_; }
  bool has_more_documents() const { return has_more_documents_; }

 private:
  std::unique_ptr<DocumentData> data_;
  std::optional<DocumentError> error_;
  bool has_more_documents_ = false;
};

}  // namespace ambf::adf
