// Collects the findings of one file, with the block at hand. Shows at most limits::kDiagnostics of them, but forgets no
// error. One thread.
#pragma once

#include <string>
#include <vector>

#include "adf/document.h"
#include "base/diagnostic.h"

namespace ambf::adf {

class Report {
 public:
  explicit Report(std::string file) : file_(std::move(file)) {}

  void error(Mark at, std::string key, std::string message, std::string hint = {});
  void warning(Mark at, std::string key, std::string message, std::string hint = {});
  void information(Mark at, std::string key, std::string message, std::string hint = {});
  void add(base::Severity severity, Mark at, std::string key, std::string message, std::string hint = {});

  // Findings from now on belong to this block ("" for the header).
  void set_block(const std::string& block);
  const std::string& file() const { return file_; }
  bool full() const { return diagnostics_.size() >= limits::kDiagnostics; }
  bool has_errors() const { return errors_ > 0; }
  std::size_t errors() const { return errors_; }

  base::Diagnostics take();

  // The nearest known word for a hint; "" when none is near, or when the file has cost enough hints already.
  std::string nearest(std::string_view wanted, const std::vector<std::string>& known);

 private:
  std::string file_, block_;
  base::Diagnostics diagnostics_;
  std::size_t errors_ = 0, hidden_ = 0, hidden_errors_ = 0;
  std::size_t hint_budget_ = limits::kHintCandidates;
};

// Said of values that may be meant, but most likely are not.
inline constexpr double kManyTurns = 12.6;  // rad, two turns
inline constexpr const char* kInRadians = "more than two turns; angles are in radians";
inline constexpr const char* kDrivesAway = "a negative gain drives away from what is commanded";

// A scalar as it is quoted in a message: shortened, control characters shown as '?'.
std::string in_quotes(std::string_view text);
// A path, whole unless it is absurdly long.
std::string shown_path(std::string_view path);
// What a value is, for "found ...": "the number 5", "the text 'heavy'", "a list", "nothing".
std::string describe(const Value& value);

}  // namespace ambf::adf
