#include "model/detail/names.h"

#include "state/kinds.h"

namespace ambf::model {

std::string Names::reserve(state::ObjectKind kind, const std::string& identifier, const std::string& name) {
  auto& identifiers = identifiers_[kind];
  const bool has_topic = state::info_of(kind).has_topics;
  std::string number;
  for (std::size_t i = 1;
       identifiers.count(identifier + number) != 0 || (has_topic && topics_.count(name + number) != 0); ++i)
    number = std::to_string(i);
  identifiers.insert(identifier + number);
  if (has_topic) topics_.insert(name + number);
  return number;
}

void Names::release(state::ObjectKind kind, const std::string& identifier, const std::string& name) {
  identifiers_[kind].erase(identifier);
  if (state::info_of(kind).has_topics) topics_.erase(name);
}

}  // namespace ambf::model
