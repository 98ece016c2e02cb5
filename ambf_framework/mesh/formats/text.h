// Private to mesh/: small scanner for text formats. Numbers are read the same way in every locale. No allocation but in
// in_quotes().
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ambf::mesh {

inline bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// Takes the next line (without its end) off `rest`; false at the end of the text.
bool take_line(std::string_view& rest, std::string_view& out_line);
// Takes the next word off `line`; empty at its end.
std::string_view take_word(std::string_view& line);
std::string_view trim(std::string_view text);
bool equal_ignoring_case(std::string_view a, std::string_view b);
bool starts_with_ignoring_case(std::string_view text, std::string_view prefix);

// The whole word is one finite number (a leading '+' is fine; too small reads as 0). False otherwise.
bool parse_double(std::string_view word, double& out);
bool parse_float(std::string_view word, float& out);
bool parse_integer(std::string_view word, std::int64_t& out);

// The word in quotes for a message: printable, cut to the given length.
std::string in_quotes(std::string_view word, std::size_t longest = 40);

// Words of a whole text with the line they stand on.
class WordScanner {
 public:
  explicit WordScanner(std::string_view text) : rest_(text) {}
  std::string_view next();  // empty at the end
  void skip_line();
  int line() const { return line_; }  // of the word last returned, 1-based

 private:
  std::string_view rest_;
  int line_ = 1;
};

}  // namespace ambf::mesh
