// Tokens of YAML: where they end, and how a value is written as some.
#include <algorithm>
#include <cctype>

#include "adf/detail/text_edit.h"

namespace ambf::adf {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool ends_flow_token(char c) { return std::string_view(",[]{}").find(c) != std::string_view::npos; }

bool is_null_word(std::string_view text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

bool may_be_plain(std::string_view text) {
  if (is_null_word(text) || text.starts_with("...") || text.back() == ' ') return false;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const bool sign = text.front() == '-' || text.front() == '+';
  if (sign && (text.size() < 2 || !(digit(text[1]) || text[1] == '.'))) return false;
  if (text.front() == ' ') return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_./+- ").find(c) != std::string_view::npos;
  });
}

std::size_t end_of_quotes(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 == text.size() || text[i + 1] != quote) return i + 1;
      ++i;
    }
  }
  return std::string_view::npos;
}

std::string list_in_one_line(const Value& list, const Change& change) {
  std::string out;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Value item = list.item(i);
    if (item.is_scalar() && change.without.contains(item.text())) continue;
    const auto inner = change.items.find(i);
    out += (out.empty() ? "" : ", ") + in_one_line(item, inner == change.items.end() ? Change{} : inner->second);
  }
  return "[" + out + "]";
}

std::string map_in_one_line(const Value& map, const Change& change) {
  std::string out;
  std::set<std::string> written;
  const auto add = [&out](const std::string& key, const std::string& value) {
    out += (out.empty() ? "" : ", ") + key + ": " + value;
  };
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto [key, value] = map.entry(i);
    const bool first = key.is_scalar() && written.insert(key.text()).second;
    const Change* inner = first ? change.find(key.text()) : nullptr;
    const bool made = inner != nullptr && value.is_absent();
    add(in_one_line(key, {}), made ? in_one_line(*inner) : in_one_line(value, inner == nullptr ? Change{} : *inner));
  }
  for (const auto& [key, inner] : change.keys)
    if (!written.contains(key)) add(as_scalar(key), in_one_line(inner));
  return "{" + out + "}";
}

}  // namespace

std::string as_scalar(const std::string& text) {
  if (may_be_plain(text)) return text;
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      out += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string in_one_line(const Change& change) {
  if (change.scalar) return as_scalar(*change.scalar);
  return map_in_one_line({}, change);
}

std::string in_one_line(const Value& value, const Change& change) {
  if (change.scalar) return as_scalar(*change.scalar);
  switch (value.kind()) {
    case Value::Kind::null: return "~";
    case Value::Kind::scalar: return as_scalar(value.text());
    case Value::Kind::list: return list_in_one_line(value, change);
    case Value::Kind::map: return map_in_one_line(value, change);
  }
  return {};
}

std::size_t behind_properties(std::string_view text, std::size_t at) {
  while (at < text.size() && (text[at] == '&' || text[at] == '!')) {
    while (at < text.size() && !is_blank(text[at])) ++at;
    while (at < text.size() && (is_blank(text[at]) || text[at] == '#')) {
      if (text[at] == '#') at = std::min(text.find('\n', at), text.size() - 1);
      ++at;
    }
  }
  return at;
}

std::size_t end_of_token(std::string_view text, std::size_t at, bool in_flow) {
  if (at >= text.size() || text[at] == '|' || text[at] == '>') return std::string_view::npos;
  if (text[at] == '"' || text[at] == '\'') return end_of_quotes(text, at);
  std::size_t end = at;
  if (text[at] == '*') {
    while (end < text.size() && !is_blank(text[end]) && !ends_flow_token(text[end])) ++end;
    return end;
  }
  for (; end < text.size() && text[end] != '\n' && text[end] != '\r'; ++end) {
    if (in_flow && ends_flow_token(text[end])) break;
    const char next = end + 1 < text.size() ? text[end + 1] : '\n';
    if (text[end] == ':' && (is_blank(next) || (in_flow && ends_flow_token(next)))) break;
    if (is_blank(text[end]) && next == '#') break;
  }
  while (end > at && is_blank(text[end - 1])) --end;
  return end;
}

}  // namespace ambf::adf
