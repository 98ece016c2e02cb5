// Fills a description from a map that has passed KeyCheck: each key that is given sets the member that its row binds.
// One thread.
#pragma once

#include "adf/detail/fields.h"
#include "adf/document.h"
#include "scene/keys.h"

namespace ambf::adf {

// `object` is of the type that the group's rows are bound to. Keys of included groups, which fill descriptions of their
// own, are left out.
void fill_untyped(const Value& map, const scene::Group& group, void* object);

template <class T>
void fill(const Value& map, const scene::Group& group, T& object) {
  fill_untyped(map, group, &object);
}

// A description with its defaults and what the map gives.
template <class T>
T read(const Value& map, const scene::Group& group, const scene::Defaults& defaults) {
  T object = defaults.get<T>();
  fill(map, group, object);
  return object;
}

// What a choice's word means; none when it is absent or not known.
template <class Enum>
std::optional<Enum> read_choice(const Fields& fields, const scene::Group& group, std::string_view name) {
  const scene::Key* key = scene::find_key(group, name);
  const scene::Word* word = key == nullptr ? nullptr : scene::find_word(*key, fields.text(name));
  return word == nullptr ? std::nullopt : std::optional(static_cast<Enum>(word->value));
}

}  // namespace ambf::adf
