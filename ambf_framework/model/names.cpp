#include "model/detail/names.h"

#include "state/kinds.h"

namespace ambf::model {

std::string Names::reserve(state::ObjectKind kind, const std::string& identifier, const std::string& name,
                           const std::string& wanted) {
  auto& identifiers = identifiers_[kind];
  const bool has_topic = state::info_of(kind).has_topics;
  const auto taken = [&](const std::string& number) {
    return identifiers.count(identifier + number) != 0 || (has_topic && topics_.count(name + number) != 0);
  };
  std::string number = taken(wanted) ? "" : wanted;
  for (std::size_t i = 1; taken(number); ++i) number = std::to_string(i);
  identifiers.insert(identifier + number);
  if (has_topic) topics_.insert(name + number);
  return number;
}

void Names::release(state::ObjectKind kind, const std::string& identifier, const std::string& name) {
  identifiers_[kind].erase(identifier);
  if (state::info_of(kind).has_topics) topics_.erase(name);
}

}  // namespace ambf::model
