#include "ros_comm/endpoints/parameters.h"

#include <algorithm>
#include <cmath>

namespace ambf::ros_comm {

bool same(const Parameter& a, const Parameter& b) {
  const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
  if (x == nullptr || y == nullptr) return a == b;
  return std::abs(*x - *y) <= 1e-9 * std::max({1.0, std::abs(*x), std::abs(*y)});
}

void read_number(const Parameters& changed, const char* name, double& value, std::string& problem) {
  const auto found = changed.find(name);
  if (found == changed.end() || !problem.empty()) return;
  if (const auto* number = std::get_if<double>(&found->second)) {
    value = *number;
  } else {
    problem = std::string(name) + " must be a number";
  }
}

void read_choice(const Parameters& changed, const ParameterChoice& choice, int& index, std::string& problem) {
  const auto found = changed.find(choice.name);
  if (found == changed.end() || !problem.empty()) return;
  const auto* given = std::get_if<std::string>(&found->second);
  const int count = choice.words[2] == nullptr ? 2 : 3;
  for (int i = 0; given != nullptr && i < count; ++i) {
    if (*given != choice.words[i]) continue;
    index = i;
    return;
  }
  problem = std::string(choice.name) + " must be " + choice.words[0] + (count == 3 ? ", " : " or ") + choice.words[1];
  if (count == 3) problem += std::string(" or ") + choice.words[2];
}

}  // namespace ambf::ros_comm
