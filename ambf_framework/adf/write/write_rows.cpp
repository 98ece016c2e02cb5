#include "adf/detail/write_rows.h"

#include "adf/detail/exact_rpy.h"
#include "adf/detail/text_edit.h"

namespace ambf::adf {

namespace {

using scene::Key;
using scene::KeyStatus;
using scene::KeyType;

double plain(double number) { return number == 0.0 ? 0.0 : number; }  // no -0

// The text of a member; empty where it is what an unchanged description has and nobody requires it.
struct Text {
  const Key& key;
  const scene::Member& unchanged;
  const OwnKeys& own;

  template <class T>
  bool is_default(const T* value) const {
    const auto* other = std::get_if<T*>(&unchanged);
    return !key.required && other != nullptr && **other == *value;
  }
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(const bool* v) const { return is_default(v) ? "" : *v ? "true" : "false"; }
  std::string operator()(const int* v) const { return is_default(v) ? "" : std::to_string(*v); }
  std::string operator()(const unsigned* v) const { return is_default(v) ? "" : std::to_string(*v); }
  std::string operator()(const double* v) const { return is_default(v) ? "" : flow(*v); }
  std::string operator()(const std::string* v) const { return is_default(v) ? "" : as_scalar(*v); }
  std::string operator()(const math::Vec3* v) const {
    if (key.type == KeyType::map) {
      const auto* other = std::get_if<math::Vec3*>(&unchanged);
      return map(v, other == nullptr ? nullptr : *other);
    }
    return is_default(v) ? "" : flow(*v);
  }
  std::string operator()(const math::Pose* v) const { return is_default(v) ? "" : flow(*v); }
  std::string operator()(const std::optional<double>* v) const { return *v ? flow(**v) : ""; }
  std::string operator()(const std::optional<math::Vec3>* v) const { return *v ? flow(**v) : ""; }
  std::string operator()(const std::optional<math::Pose>* v) const { return *v ? flow(**v) : ""; }
  std::string operator()(const std::vector<std::string>* v) const { return is_default(v) ? "" : flow(*v); }
  std::string operator()(const scene::EnumMember& v) const {
    const auto* other = std::get_if<scene::EnumMember>(&unchanged);
    const int value = v.get(v.value);
    return !key.required && other != nullptr && other->get(other->value) == value ? "" : first_word(key, value);
  }
  std::string operator()(const scene::InnerMember& v) const {
    const auto* other = std::get_if<scene::InnerMember>(&unchanged);
    return map(v.object, other == nullptr ? nullptr : other->object);
  }

  std::string map(const void* object, const void* of_unchanged) const {
    const WrittenKeys keys = written_keys(*key.sub, object, of_unchanged, own);
    return keys.empty() ? "" : flow(keys);
  }
};

}  // namespace

std::string flow(const WrittenKeys& keys) {
  std::string text;
  for (const auto& [name, value] : keys) text += (text.empty() ? "" : ", ") + as_scalar(name) + ": " + value;
  return "{" + text + "}";
}

std::string flow(double number) { return scene::text_of(plain(number)); }

std::string flow(const math::Vec3& v) { return "{x: " + flow(v.x) + ", y: " + flow(v.y) + ", z: " + flow(v.z) + "}"; }

std::string flow(const math::Pose& pose) {
  const math::Vec3 rpy = exact_rpy(pose.orientation);
  return "{position: " + flow(pose.position) + ", orientation: {r: " + flow(rpy.x) + ", p: " + flow(rpy.y) +
         ", y: " + flow(rpy.z) + "}}";
}

std::string flow(const std::vector<std::string>& texts) {
  std::string text;
  for (const std::string& item : texts) text += (text.empty() ? "" : ", ") + as_scalar(item);
  return "[" + text + "]";
}

std::string first_word(const Key& key, int value) {
  for (const scene::Word& word : key.words)
    if (word.value == value) return as_scalar(std::string(word.text));
  return {};
}

WrittenKeys written_keys(const scene::Group& group, const void* object, const void* unchanged, const OwnKeys& own) {
  WrittenKeys keys;
  for (const Key& key : group.keys) {
    if (key.status != KeyStatus::current || !key.preferred.empty()) continue;
    std::string text;
    if (const auto given = own(key)) {
      text = *given;
    } else if (key.member) {
      const void* other = unchanged != nullptr ? unchanged : key.member.unchanged();
      const scene::Member of_other = key.member.find(const_cast<void*>(other));
      text = std::visit(Text{key, of_other, own}, key.member.find(const_cast<void*>(object)));
    } else if (key.type == KeyType::map && scene::fills_owner(key)) {
      const WrittenKeys inner = written_keys(*key.sub, object, unchanged, own);
      text = inner.empty() ? "" : flow(inner);
    }
    if (!text.empty()) keys.emplace_back(key.name, text);
  }
  return keys;
}

}  // namespace ambf::adf
