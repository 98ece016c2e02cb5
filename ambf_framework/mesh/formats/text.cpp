#include "mesh/formats/text.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <system_error>

namespace ambf::mesh {

namespace {
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
}  // namespace

bool take_line(std::string_view& rest, std::string_view& out_line) {
  if (rest.empty()) return false;
  const void* found = std::memchr(rest.data(), '\n', rest.size());
  const std::size_t length =
      found == nullptr ? rest.size() : static_cast<std::size_t>(static_cast<const char*>(found) - rest.data());
  out_line = rest.substr(0, length);
  rest.remove_prefix(found == nullptr ? length : length + 1);
  return true;
}

std::string_view take_word(std::string_view& line) {
  std::size_t begin = 0;
  while (begin < line.size() && is_space(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_space(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (is_space(text.front()) || text.front() == '\n')) text.remove_prefix(1);
  while (!text.empty() && (is_space(text.back()) || text.back() == '\n')) text.remove_suffix(1);
  return text;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() && starts_with_ignoring_case(a, b);
}

bool starts_with_ignoring_case(std::string_view text, std::string_view prefix) {
  if (text.size() < prefix.size()) return false;
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    if (lower(text[i]) != lower(prefix[i])) return false;
  }
  return true;
}

bool parse_double(std::string_view word, double& out) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  if (word.empty() || word.front() == '+') return false;
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return false;
  if (error == std::errc::result_out_of_range) {
    // Out of range is either too large (refused) or too small (zero); the sign of the exponent decides.
    const std::size_t e = word.find_first_of("eE");
    const bool tiny = e == std::string_view::npos ? word.find_first_of("123456789") > word.find('.')
                                                  : e + 1 < word.size() && word[e + 1] == '-';
    if (!tiny) return false;
    value = 0.0;
  } else if (error != std::errc() || !std::isfinite(value)) {
    return false;
  }
  out = value;
  return true;
}

bool parse_float(std::string_view word, float& out) {
  double value = 0.0;
  if (!parse_double(word, value) || std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()))
    return false;
  out = static_cast<float>(value);
  return true;
}

bool parse_integer(std::string_view word, std::int64_t& out) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  if (word.empty() || word.front() == '+') return false;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
  return error == std::errc() && end == word.data() + word.size();
}

std::string in_quotes(std::string_view word, std::size_t longest) {
  std::string text = "'";
  for (char c : word.substr(0, longest)) text += (c >= ' ' && c <= '~') ? c : '?';
  return text + (word.size() > longest ? "...'" : "'");
}

std::string_view WordScanner::next() {
  std::size_t begin = 0;
  while (begin < rest_.size() && (is_space(rest_[begin]) || rest_[begin] == '\n')) {
    line_ += rest_[begin] == '\n' ? 1 : 0;
    ++begin;
  }
  std::size_t end = begin;
  while (end < rest_.size() && !is_space(rest_[end]) && rest_[end] != '\n') ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

void WordScanner::skip_line() {
  const std::size_t end = rest_.find('\n');
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end);
}

}  // namespace ambf::mesh
