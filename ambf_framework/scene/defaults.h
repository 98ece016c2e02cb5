// The defaults of descriptions: what a member is while no key gives it. They are those of the structs; a table of
// changed ones serves tests and programs that want others. Plain data; read by any thread.
#pragma once

#include <map>
#include <memory>

#include "scene/binding.h"

namespace ambf::scene {

class Defaults {
 public:
  // A description of this type as it is before its block is read.
  template <class T>
  T get() const {
    const auto found = changed_.find(type_of<T>());
    return found == changed_.end() ? T{} : *static_cast<const T*>(found->second.get());
  }
  template <class T>
  void set(T value) {
    changed_[type_of<T>()] = std::make_shared<const T>(std::move(value));
  }
  // The owner of a bound member.
  const void* owner_of(const Binding& binding) const {
    const auto found = changed_.find(binding.owner);
    return found == changed_.end() ? binding.unchanged() : found->second.get();
  }

 private:
  std::map<const void*, std::shared_ptr<const void>> changed_;  // by type_of
};

}  // namespace ambf::scene
