#include "adf/detail/bind.h"

#include <algorithm>

#include "adf/detail/fields.h"
#include "adf/detail/scalars.h"

namespace ambf::adf {

namespace {

using scene::Key;
using scene::KeyStatus;

double cut(double number, const Key& key) { return std::min(number, key.max); }

// Sets one member from one value; what does not fit the member (a map where it is a number) leaves it as it was.
struct Setter {
  const Fields& fields;
  const Key& key;
  const Value& value;

  std::optional<double> number() const {
    const auto found = fields.number(key.name);
    return found ? std::optional(cut(*found, key)) : std::nullopt;
  }

  void operator()(std::monostate) const {}
  void operator()(bool* member) const { *member = fields.flag(key.name, *member); }
  void operator()(int* member) const {
    if (const auto found = number()) *member = static_cast<int>(*found);
  }
  void operator()(unsigned* member) const {
    if (const auto found = number(); found && *found >= 0.0) *member = static_cast<unsigned>(*found);
  }
  void operator()(double* member) const { *member = number().value_or(*member); }
  void operator()(std::optional<double>* member) const {
    if (const auto found = number()) *member = found;
  }
  void operator()(std::string* member) const {
    const std::string text = fields.text(key.name, *member);
    if (key.words.empty() || scene::find_word(key, text) != nullptr) *member = text;
  }
  void operator()(math::Vec3* member) const {
    if (key.type == scene::KeyType::map) {
      fill(value, *key.sub, *member);
    } else {
      *member = fields.number_or_vector(key.name, *member);
    }
  }
  void operator()(std::optional<math::Vec3>* member) const { *member = fields.vector(key.name); }
  void operator()(math::Pose* member) const { *member = fields.pose(key.name).value_or(*member); }
  void operator()(std::optional<math::Pose>* member) const { *member = fields.pose(key.name); }
  void operator()(std::vector<std::string>* member) const { *member = fields.texts(key.name); }
  void operator()(const scene::EnumMember& member) const {
    const scene::Word* word = scene::find_word(key, fields.text(key.name));
    if (word == nullptr) word = scene::find_word(key, key.instead);
    if (word != nullptr) member.set(member.value, word->value);
  }
  void operator()(const scene::InnerMember& inner) const { fill_untyped(value, *key.sub, inner.object); }
};

}  // namespace

void fill_untyped(const Value& map, const scene::Group& group, void* object) {
  const Fields fields(map);
  for (const Key& key : group.keys) {
    const bool has_effect = key.status == KeyStatus::current || key.status == KeyStatus::older;
    if (!has_effect || (!key.preferred.empty() && fields.has(key.preferred))) continue;
    const auto value = map.find(key.name);
    if (!value) continue;
    if (key.member) {
      std::visit(Setter{fields, key, *value}, key.member.find(object));
    } else if (key.type == scene::KeyType::map && scene::fills_owner(key)) {
      fill_untyped(*value, *key.sub, object);
    }
  }
}

}  // namespace ambf::adf
