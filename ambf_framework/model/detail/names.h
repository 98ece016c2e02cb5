// Which names are taken: the numbers that distinguish equally named objects (ADF 1.4; dissertation §4.3.5). Loader
// thread.
#pragma once

#include <map>
#include <string>
#include <unordered_set>

#include "state/ids.h"

namespace ambf::model {

class Names {
 public:
  // `wanted`, else the smallest of "", "1", "2", .. that makes both `identifier` + number (among objects of this kind)
  // and `name` + number (among all topics) free; both are then taken. Both are fully qualified. Joints have no topics:
  // their names may repeat.
  std::string reserve(state::ObjectKind kind, const std::string& identifier, const std::string& name,
                      const std::string& wanted = {});
  // Takes both, number included, free again.
  void release(state::ObjectKind kind, const std::string& identifier, const std::string& name);

 private:
  std::map<state::ObjectKind, std::unordered_set<std::string>> identifiers_;
  std::unordered_set<std::string> topics_;
};

}  // namespace ambf::model
