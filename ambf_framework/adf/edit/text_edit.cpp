#include "adf/detail/text_edit.h"

#include <algorithm>
#include <unordered_set>

namespace ambf::adf {

Change& Change::key(std::string_view name) {
  for (auto& [known, change] : keys)
    if (known == name) return change;
  keys.push_back({std::string(name), {}});
  return keys.back().change;
}

const Change* Change::find(std::string_view name) const {
  for (const auto& [known, change] : keys)
    if (known == name) return &change;
  return nullptr;
}

bool Change::empty() const { return !scalar && keys.empty() && items.empty() && without.empty(); }

namespace {

constexpr std::size_t kNone = std::string::npos;

struct Refusal {
  DocumentError error;
};

class Editor {
 public:
  explicit Editor(const std::string& text) : text_(text) {
    lines_.push_back(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);  // marks do not count a byte order mark
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') lines_.push_back(i + 1);
    const std::size_t first_end = text.find('\n');
    new_line_ = first_end != kNone && first_end > 0 && text[first_end - 1] == '\r' ? "\r\n" : "\n";
  }

  std::string run(const Value& root, const Change& wanted) {
    change(root, wanted, false);
    if (anchors_changed_) keep_aliases(root);
    std::sort(splices_.begin(), splices_.end(), [](const Splice& a, const Splice& b) { return a.begin < b.begin; });
    std::string out;
    std::size_t at = 0;
    for (const Splice& splice : splices_) {
      if (splice.begin < at) throw Refusal{{"two changes meet at one place", kByHand, {}}};
      out.append(text_, at, splice.begin - at);
      out += splice.text;
      at = splice.end;
    }
    return out.append(text_, at, kNone);
  }

  static constexpr const char* kByHand = "write the change by hand";

 private:
  struct Splice {
    std::size_t begin, end;
    std::string text;
  };

  std::size_t offset(Mark mark) const {
    const std::size_t line = static_cast<std::size_t>(mark.line - 1);
    if (mark.line < 1 || line >= lines_.size()) throw Refusal{{"a value has no place in the text", kByHand, mark}};
    return std::min(lines_[line] + static_cast<std::size_t>(mark.column - 1), text_.size());
  }
  char at(std::size_t place) const { return place < text_.size() ? text_[place] : '\0'; }
  bool is_alias(const Value& value) const { return value.anchored() && at(offset(value.mark())) == '*'; }

  void change(const Value& value, const Change& wanted, bool in_flow) {
    if (wanted.empty()) return;
    const std::size_t start = offset(value.mark());
    if (is_alias(value)) {
      written_.insert(start);
      splices_.push_back({start, end_of_token(text_, start, in_flow), in_one_line(value, wanted)});
      return;
    }
    changed_.insert(value.id());
    anchors_changed_ |= value.anchored();
    const std::size_t inside = behind_properties(text_, start);
    const bool flow = in_flow || at(inside) == '{' || at(inside) == '[';
    if (wanted.scalar) {
      if (!value.is_scalar()) throw Refusal{{"expected one value, found several", kByHand, value.mark()}};
      replace_scalar(value, inside, *wanted.scalar, in_flow);
    } else if (value.is_list()) {
      for (const auto& [item, inner] : wanted.items) change(value.item(item), inner, flow);
      leave_out(value, wanted.without, flow);
    } else if (value.is_map()) {
      change_map(value, wanted, inside, flow);
    } else {
      throw Refusal{{"expected a list or a map of keys", kByHand, value.mark()}};
    }
  }

  void replace_scalar(const Value& value, std::size_t start, const std::string& wanted, bool in_flow) {
    const std::size_t end = end_of_token(text_, start, in_flow);
    if (end == kNone) throw Refusal{{"text over several lines is not edited", kByHand, value.mark()}};
    std::string token = as_scalar(wanted);
    const char quote = at(start);
    const bool plain = token == wanted;
    if (plain && (quote == '"' || quote == '\'')) token = quote + wanted + quote;
    splices_.push_back({start, end, token});
  }

  void change_map(const Value& map, const Change& wanted, std::size_t start, bool flow) {
    std::vector<std::pair<std::string, std::string>> added;
    for (const auto& [name, inner] : wanted.keys) {
      std::size_t entry = 0;
      while (entry < map.size() && !(map.entry(entry).key.is_scalar() && map.entry(entry).key.text() == name)) ++entry;
      if (entry == map.size()) {
        added.emplace_back(as_scalar(name), in_one_line(inner));
      } else if (map.entry(entry).value.is_absent()) {
        fill(map.entry(entry), in_one_line(inner), flow);
      } else {
        change(map.entry(entry).value, inner, flow);
      }
    }
    if (added.empty()) return;
    if (at(start) == '{') {
      std::string keys;
      for (const auto& [name, value] : added) keys += (keys.empty() ? "" : ", ") + name + ": " + value;
      splices_.push_back({start + 1, start + 1, keys + (map.size() > 0 ? ", " : "")});
    } else {
      add_lines(map, added);
    }
  }

  // A key that is there without a value.
  void fill(const Value::Entry& entry, const std::string& value, bool flow) {
    const std::size_t key = behind_properties(text_, offset(entry.key.mark()));
    std::size_t colon = end_of_token(text_, key, flow);
    while (colon != kNone && at(colon) == ' ') ++colon;
    if (colon == kNone || at(colon) != ':') throw Refusal{{"a key without a value", kByHand, entry.key.mark()}};
    std::size_t start = colon + 1;
    while (at(start) == ' ' || at(start) == '\t') ++start;
    const std::size_t end = end_of_token(text_, start, flow);
    if (end != kNone && end > start && at(start) != '#') {
      splices_.push_back({start, end, value});  // ~, null or ""
    } else {
      splices_.push_back({colon + 1, colon + 1, " " + value});
    }
  }

  // Beneath a line that says something of the same map.
  void add_lines(const Value& map, const std::vector<std::pair<std::string, std::string>>& added) {
    std::size_t above = kNone;
    const auto line_of = [&](const Value::Entry& entry) {
      const std::size_t start = behind_properties(text_, offset(entry.value.mark()));
      const std::size_t end = end_of_token(text_, start, false);
      return end == kNone ? kNone : std::min(text_.find('\n', end), text_.size());
    };
    for (const std::string_view wanted : {"mass", "name", "namespace", "adf version", ""}) {
      for (std::size_t i = 0; i < map.size() && above == kNone; ++i) {
        const auto entry = map.entry(i);
        const bool fits = entry.key.is_scalar() && (wanted.empty() || entry.key.text() == wanted);
        if (fits && entry.value.is_scalar() && !entry.value.is_absent()) above = line_of(entry);
      }
    }
    const std::size_t first = offset(map.entry(0).key.mark());
    const std::size_t line = text_.rfind('\n', first == 0 ? 0 : first - 1);
    const std::size_t line_start = first == 0 || line == kNone ? lines_.front() : line + 1;
    const std::string indent(first - line_start, ' ');
    std::string lines;
    for (const auto& [name, value] : added) {
      const std::string entry = name + ": " + value;
      lines += above == kNone ? entry + new_line_ + indent : new_line_ + indent + entry;
    }
    if (above == kNone) above = first;
    if (above > first && above > 0 && at(above - 1) == '\r') --above;
    splices_.push_back({above, above, lines});
  }

  void leave_out(const Value& list, const std::set<std::string>& without, bool flow) {
    const auto gone = [&](std::size_t i) {
      return i < list.size() && list.item(i).is_scalar() && without.contains(list.item(i).text());
    };
    const auto begin_of = [&](std::size_t i) { return offset(list.item(i).mark()); };
    const auto end_of = [&](std::size_t i) {
      const std::size_t end = end_of_token(text_, behind_properties(text_, begin_of(i)), flow);
      if (end == kNone) throw Refusal{{"a name over several lines is not edited", kByHand, list.item(i).mark()}};
      return end;
    };
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!gone(i)) continue;
      written_.insert(begin_of(i));
      if (!flow) {
        const std::size_t start = lines_[static_cast<std::size_t>(list.item(i).mark().line - 1)];
        const std::size_t end = std::min(text_.find('\n', end_of(i)), text_.size() - 1) + 1;
        splices_.push_back({start, end, ""});
        continue;
      }
      std::size_t last = i;
      while (gone(last + 1)) written_.insert(begin_of(++last));
      const std::size_t start = last + 1 == list.size() && i > 0 ? end_of(i - 1) : begin_of(i);
      splices_.push_back({start, last + 1 == list.size() ? end_of(last) : begin_of(last + 1), ""});
      i = last;
    }
  }

  // Aliases of what has changed are written out as what it was.
  void keep_aliases(const Value& value, bool in_flow = false) {
    if (value.is_null()) return;
    const std::size_t start = offset(value.mark());
    if (is_alias(value)) {
      if (changed_.contains(value.id()) && !written_.contains(start))
        splices_.push_back({start, end_of_token(text_, start, in_flow), in_one_line(value, {})});
      return;
    }
    const char first = at(behind_properties(text_, start));
    const bool flow = in_flow || first == '{' || first == '[';
    for (std::size_t i = 0; i < value.size(); ++i)
      keep_aliases(value.is_map() ? value.entry(i).value : value.item(i), flow);
  }

  const std::string& text_;
  std::vector<std::size_t> lines_;  // where each starts
  std::string new_line_;
  std::vector<Splice> splices_;
  std::unordered_set<std::uint32_t> changed_;  // Value::id
  std::unordered_set<std::size_t> written_;    // aliases that are written out, items that are left out
  bool anchors_changed_ = false;
};

bool is_utf8(const std::string& text) {
  return !text.starts_with("\xFE\xFF") && !text.starts_with("\xFF\xFE") && text.find('\0') == kNone;
}

}  // namespace

EditedText edit(const std::string& text, const Document& document, const Change& change) {
  if (change.empty()) return {text, {}};
  if (!is_utf8(text)) return {{}, DocumentError{"only text in UTF-8 is edited", "convert the file to UTF-8", {}}};
  try {
    std::string edited = Editor(text).run(document.root(), change);
    const Document again(edited);
    if (!again.error() && is_edited(document.root(), change, again.root())) return {std::move(edited), {}};
    return {{}, DocumentError{"the text would not read back as what is wanted", Editor::kByHand, {}}};
  } catch (const Refusal& refusal) {
    return {{}, refusal.error};
  }
}

}  // namespace ambf::adf
