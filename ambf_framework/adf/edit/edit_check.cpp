#include "adf/detail/text_edit.h"

namespace ambf::adf {

namespace {

// Is it what the change makes of nothing?
bool is_made(const Change& change, const Value& value) {
  if (change.scalar) return value.is_scalar() && value.text() == *change.scalar;
  if (!value.is_map() || value.size() != change.keys.size()) return false;
  for (const auto& [name, inner] : change.keys) {
    const auto found = value.find(name);
    if (!found || !is_made(inner, *found)) return false;
  }
  return true;
}

bool is_edited_list(const Value& before, const Change& change, const Value& after) {
  std::size_t at = 0;
  const std::size_t left = after.is_list() ? after.size() : 0;  // a list that has lost all its lines reads as nothing
  if (!after.is_list() && !after.is_null()) return false;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Value item = before.item(i);
    if (item.is_scalar() && change.without.contains(item.text())) continue;
    const auto inner = change.items.find(i);
    const Change wanted = inner == change.items.end() ? Change{} : inner->second;
    if (at == left || !is_edited(item, wanted, after.item(at++))) return false;
  }
  return at == left;
}

bool is_edited_map(const Value& before, const Change& change, const Value& after) {
  if (!after.is_map()) return false;
  std::set<std::string> known, added;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before.entry(i).key.is_scalar()) known.insert(before.entry(i).key.text());
  std::set<std::string> seen;
  std::size_t at = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto [key, value] = after.entry(i);
    const Change* inner = key.is_scalar() ? change.find(key.text()) : nullptr;
    if (inner != nullptr && !known.contains(key.text())) {
      if (!added.insert(key.text()).second || !is_made(*inner, value)) return false;
      continue;
    }
    if (at == before.size()) return false;
    const auto [old_key, old_value] = before.entry(at++);
    if (!is_edited(old_key, {}, key)) return false;
    const bool first = key.is_scalar() && seen.insert(key.text()).second;
    if (inner == nullptr || !first) {
      if (!is_edited(old_value, {}, value)) return false;
    } else if (old_value.is_absent() ? !is_made(*inner, value) : !is_edited(old_value, *inner, value)) {
      return false;
    }
  }
  std::size_t wanted = 0;
  for (const auto& [name, inner] : change.keys) wanted += known.contains(name) ? 0 : 1;
  return at == before.size() && added.size() == wanted;
}

}  // namespace

bool is_edited(const Value& before, const Change& change, const Value& after) {
  if (change.scalar) return after.is_scalar() && after.text() == *change.scalar;
  switch (before.kind()) {
    case Value::Kind::null: return after.is_null();
    case Value::Kind::scalar: return after.is_scalar() && after.text() == before.text();
    case Value::Kind::list: return is_edited_list(before, change, after);
    case Value::Kind::map: return is_edited_map(before, change, after);
  }
  return false;
}

}  // namespace ambf::adf
