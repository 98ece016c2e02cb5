#include "adf/detail/fields.h"

#include "adf/detail/scalars.h"
#include "math/rotation.h"

namespace ambf::adf {

Mark Fields::mark(std::string_view key) const {
  const auto value = map_.find(key);
  return value ? value->mark() : map_.mark();
}

Fields Fields::map(std::string_view key) const { return Fields(map_.find(key).value_or(Value())); }

std::vector<Fields> Fields::maps(std::string_view key) const {
  std::vector<Fields> items;
  if (const auto list = map_.find(key)) {
    for (std::size_t i = 0; i < list->size(); ++i) items.emplace_back(list->item(i));
  }
  return items;
}

std::optional<double> Fields::number(std::string_view key) const {
  const auto value = map_.find(key);
  return value && value->is_scalar() ? to_number(value->text()) : std::nullopt;
}

double Fields::number(std::string_view key, double fallback) const { return number(key).value_or(fallback); }

unsigned Fields::whole(std::string_view key, unsigned fallback) const {
  const auto value = map_.find(key);
  const auto number = value && value->is_scalar() ? to_integer(value->text()) : std::nullopt;
  return number && *number >= 0 ? static_cast<unsigned>(*number) : fallback;
}

bool Fields::flag(std::string_view key, bool fallback) const {
  const auto value = map_.find(key);
  return value && value->is_scalar() ? to_boolean(value->text()).value_or(fallback) : fallback;
}

std::string Fields::text(std::string_view key, const std::string& fallback) const {
  const auto value = map_.find(key);
  return value && value->is_scalar() ? value->text() : fallback;
}

std::vector<std::string> Fields::texts(std::string_view key) const {
  std::vector<std::string> items;
  if (const auto list = map_.find(key)) {
    for (std::size_t i = 0; i < list->size(); ++i) items.push_back(list->item(i).text());
  }
  return items;
}

std::vector<int> Fields::integers(std::string_view key) const {
  std::vector<int> items;
  if (const auto list = map_.find(key)) {
    for (std::size_t i = 0; i < list->size(); ++i)
      items.push_back(static_cast<int>(to_integer(list->item(i).text()).value_or(0)));
  }
  return items;
}

std::optional<math::Vec3> Fields::vector(std::string_view key) const {
  const auto value = map_.find(key);
  if (!value || !value->is_map()) return std::nullopt;
  const Fields parts(*value);
  return math::Vec3{parts.number("x", 0.0), parts.number("y", 0.0), parts.number("z", 0.0)};
}

math::Vec3 Fields::number_or_vector(std::string_view key, const math::Vec3& fallback) const {
  if (const auto all = number(key)) return {*all, *all, *all};
  return vector(key, fallback);
}

math::Quat Fields::rotation(std::string_view key) const {
  const Fields parts = map(key);
  return math::from_rpy(parts.number("r", 0.0), parts.number("p", 0.0), parts.number("y", 0.0));
}

std::optional<math::Pose> Fields::pose(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  const Fields parts = map(key);
  return math::Pose{parts.vector("position", {}), parts.rotation("orientation")};
}

}  // namespace ambf::adf
