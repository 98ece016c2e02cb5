#include "adf/detail/scalars.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace ambf::adf {

namespace {

constexpr std::size_t kLongestNumber = 400;

std::string lower(std::string_view text) {
  std::string out;
  for (char c : text) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

std::optional<std::uint64_t> to_hexadecimal(std::string_view text) {
  if (!text.starts_with("0x") && !text.starts_with("0X")) return std::nullopt;
  text.remove_prefix(2);
  std::uint64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Bytes of the printable UTF-8 character that the text starts with; 0 when it is a control character or broken.
std::size_t character_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first >= 0xf0 && first < 0xf5   ? 4
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xc2 && first < 0xe0 ? 2
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  }
  // U+0080 to U+009F are control characters too.
  return first == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0 ? 0 : length;
}

}  // namespace

std::optional<double> to_number(std::string_view text) {
  if (text.empty() || text.size() > kLongestNumber) return std::nullopt;
  if (const auto hexadecimal = to_hexadecimal(text)) return static_cast<double>(*hexadecimal);
  std::string_view digits = text;
  const bool negative = digits.front() == '-';
  if (negative || digits.front() == '+') digits.remove_prefix(1);
  if (digits.empty()) return std::nullopt;
  const std::string word = lower(digits);
  if (word == ".inf")
    return negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  if (word == ".nan") return std::numeric_limits<double>::quiet_NaN();
  // from_chars would take "inf" and "nan" too, which are plain text in YAML.
  if ((digits.front() < '0' || digits.front() > '9') && digits.front() != '.') return std::nullopt;
  double value = 0.0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size()) return std::nullopt;
  if (problem == std::errc::result_out_of_range) {
    // Too small is zero; too large is infinite, which callers refuse.
    const bool tiny = digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos ||
                      digits.front() == '.' || digits.starts_with("0.");
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  } else if (problem != std::errc()) {
    return std::nullopt;
  }
  return negative ? -value : value;
}

std::optional<std::int64_t> to_integer(std::string_view text) {
  const auto number = to_number(text);
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (!number || !std::isfinite(*number) || std::abs(*number) > kExact || std::trunc(*number) != *number)
    return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

std::optional<bool> to_boolean(std::string_view text) {
  const std::string word = lower(text);
  const bool one_case = word == text || (text.size() > 1 && lower(text.substr(1)) == text.substr(1)) ||
                        text.find_first_of("abcdefghijklmnopqrstuvwxyz") == std::string_view::npos;
  if (!one_case) return std::nullopt;
  if (word == "true" || word == "yes" || word == "on" || word == "y" || word == "1") return true;
  if (word == "false" || word == "no" || word == "off" || word == "n" || word == "0") return false;
  return std::nullopt;
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  std::size_t at = 0;
  while (at < text.size() && out.size() < longest) {
    const std::size_t length = character_length(text.substr(at));
    out += length == 0 ? "?" : std::string(text.substr(at, length));
    at += std::max<std::size_t>(length, 1);
  }
  if (at < text.size()) out += "...";
  return out;
}

}  // namespace ambf::adf
