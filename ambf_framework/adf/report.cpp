#include "adf/report.h"

#include "adf/detail/scalars.h"
#include "scene/lookup.h"

namespace ambf::adf {

void Report::add(base::Severity severity, Mark at, std::string key, std::string message, std::string hint) {
  const bool is_error = severity == base::Severity::error;
  if (is_error) ++errors_;
  if (full()) {
    ++hidden_;
    if (is_error) ++hidden_errors_;
    return;
  }
  base::Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.file = file_;
  diagnostic.line = at.line;
  diagnostic.column = at.column;
  diagnostic.block = block_;
  diagnostic.key = std::move(key);
  diagnostic.message = std::move(message);
  diagnostic.hint = std::move(hint);
  diagnostics_.push_back(std::move(diagnostic));
}

void Report::error(Mark at, std::string key, std::string message, std::string hint) {
  add(base::Severity::error, at, std::move(key), std::move(message), std::move(hint));
}
void Report::warning(Mark at, std::string key, std::string message, std::string hint) {
  add(base::Severity::warning, at, std::move(key), std::move(message), std::move(hint));
}
void Report::information(Mark at, std::string key, std::string message, std::string hint) {
  add(base::Severity::information, at, std::move(key), std::move(message), std::move(hint));
}

void Report::set_block(const std::string& block) { block_ = block.empty() ? std::string() : printable(block); }

base::Diagnostics Report::take() {
  if (hidden_ > 0) {
    base::Diagnostic diagnostic;
    diagnostic.severity = hidden_errors_ > 0 ? base::Severity::error : base::Severity::warning;
    diagnostic.file = file_;
    diagnostic.message = "further findings are not shown: " + std::to_string(hidden_) +
                         ", errors among them: " + std::to_string(hidden_errors_);
    diagnostics_.push_back(std::move(diagnostic));
  }
  hidden_ = hidden_errors_ = errors_ = 0;
  return std::move(diagnostics_);
}

std::string Report::nearest(std::string_view wanted, const std::vector<std::string>& known) {
  if (full() || known.size() > hint_budget_) return {};
  hint_budget_ -= known.size();
  return scene::nearest(wanted, known);
}

std::string in_quotes(std::string_view text) { return "'" + printable(text) + "'"; }

std::string shown_path(std::string_view path) {
  constexpr std::size_t kLongestPath = 500;
  return printable(path, kLongestPath);
}

std::string describe(const Value& value) {
  switch (value.kind()) {
    case Value::Kind::null: return "nothing";
    case Value::Kind::list: return "a list";
    case Value::Kind::map: return "a map";
    case Value::Kind::scalar: break;
  }
  if (to_number(value.text())) return "the number " + printable(value.text());
  return "the text " + in_quotes(value.text());
}

}  // namespace ambf::adf
