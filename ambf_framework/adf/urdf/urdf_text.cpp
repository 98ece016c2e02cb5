#include "adf/detail/urdf_text.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace ambf::adf::urdf {

namespace {

void append_utf8(std::string& out, std::uint32_t code) {
  const auto byte = [&out](std::uint32_t value) { out += static_cast<char>(value); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | code >> 6), byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | code >> 12), byte(0x80 | (code >> 6 & 0x3F)), byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | code >> 18), byte(0x80 | (code >> 12 & 0x3F)), byte(0x80 | (code >> 6 & 0x3F)),
        byte(0x80 | (code & 0x3F));
  }
}

std::string from_utf16(std::string_view text, bool big_endian) {
  const auto unit = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(text[i]), second = static_cast<unsigned char>(text[i + 1]);
    return static_cast<std::uint32_t>(big_endian ? first << 8 | second : second << 8 | first);
  };
  constexpr std::uint32_t kUnknown = 0xFFFD;
  std::string out;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code == 0xFEFF) continue;  // byte order mark
    const bool high = code >= 0xD800 && code < 0xDC00, low = code >= 0xDC00 && code < 0xE000;
    if (high && i + 3 < text.size() && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(i + 2) - 0xDC00);
      i += 2;
    } else if (high || low) {
      code = kUnknown;
    }
    append_utf8(out, code);
  }
  return out;
}

// What the XML declaration says, in lower case; empty without one.
std::string declared_encoding(std::string_view text) {
  const std::size_t end = text.substr(0, 300).find("?>"), start = text.substr(0, 300).find("<?xml");
  if (start == std::string_view::npos || end == std::string_view::npos) return {};
  std::string_view declaration = text.substr(start, end - start);
  const std::size_t at = declaration.find("encoding");
  if (at == std::string_view::npos) return {};
  declaration = declaration.substr(at);
  const std::size_t quote = declaration.find_first_of("\"'");
  if (quote == std::string_view::npos) return {};
  std::string name(declaration.substr(quote + 1));
  name.resize(std::min(name.size(), name.find_first_of("\"'")));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return name;
}

}  // namespace

std::string as_utf8(std::string_view text) {
  using std::string_view_literals::operator""sv;
  if (text.starts_with("\xFF\xFE"sv) || text.starts_with("<\0"sv)) return from_utf16(text, false);
  if (text.starts_with("\xFE\xFF"sv) || text.starts_with("\0<"sv)) return from_utf16(text, true);
  const std::string encoding = declared_encoding(text);
  if (encoding != "iso-8859-1" && encoding != "latin1" && encoding != "windows-1252") return std::string(text);
  std::string out;
  for (const char c : text) append_utf8(out, static_cast<unsigned char>(c));
  return out;
}

int line_of_macro(std::string_view text) {
  int line = 1;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') ++line;
    if (text[at] != '<') continue;
    if (text.substr(at, 7) == "<xacro:") return line;
    if (text.substr(at, 4) != "<!--") continue;
    const std::size_t end = std::min(text.find("-->", at), text.size());
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                        text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at = end;
  }
  return 0;
}

}  // namespace ambf::adf::urdf
