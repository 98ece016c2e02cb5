// One finding about an input, with everything a user needs to mend it. Loading returns all of them; nobody throws.
#pragma once

#include <string>
#include <vector>

namespace ambf::base {

// What a finding costs: information and warnings change nothing, an error drops the block or the file it names.
enum class Severity { information, warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  std::string file;     // path as the user gave it; empty where there is no file
  int line = 0;         // 1-based; 0 where unknown
  int column = 0;       // 1-based; 0 where unknown
  std::string block;    // ADF block identifier, e.g. "BODY Link1"
  std::string key;      // key within the block, e.g. "mass"
  std::string message;  // what was found and what was expected
  std::string hint;     // what to do
};

using Diagnostics = std::vector<Diagnostic>;

bool has_errors(const Diagnostics& diagnostics);
bool has_warnings(const Diagnostics& diagnostics);

// "file:line:column: error: [BODY Link1: mass] message (hint)", leaving out what is empty.
std::string to_string(const Diagnostic& diagnostic);
const char* to_string(Severity severity);

}  // namespace ambf::base
