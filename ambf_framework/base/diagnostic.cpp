#include "base/diagnostic.h"

#include <algorithm>

namespace ambf::base {

namespace {
bool has(const Diagnostics& diagnostics, Severity severity) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [severity](const Diagnostic& d) { return d.severity == severity; });
}
}  // namespace

bool has_errors(const Diagnostics& diagnostics) { return has(diagnostics, Severity::error); }
bool has_warnings(const Diagnostics& diagnostics) { return has(diagnostics, Severity::warning); }

const char* to_string(Severity severity) {
  switch (severity) {
    case Severity::information: return "info";
    case Severity::warning: return "warning";
    case Severity::error: break;
  }
  return "error";
}

std::string to_string(const Diagnostic& d) {
  std::string text = d.file;
  if (d.line > 0) text += ":" + std::to_string(d.line);
  if (d.line > 0 && d.column > 0) text += ":" + std::to_string(d.column);
  if (!text.empty()) text += ": ";
  text += to_string(d.severity);
  text += ": ";
  if (!d.block.empty() || !d.key.empty()) {
    text += "[" + d.block + (d.block.empty() || d.key.empty() ? "" : ": ") + d.key + "] ";
  }
  text += d.message;
  if (!d.hint.empty()) text += " (" + d.hint + ")";
  return text;
}

}  // namespace ambf::base
