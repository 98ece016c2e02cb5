// Typed values out of a map that has passed KeyCheck. Absent keys give the fallback. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adf/document.h"
#include "math/types.h"

namespace ambf::adf {

class Fields {
 public:
  explicit Fields(Value map) : map_(map) {}

  bool has(std::string_view key) const { return map_.find(key).has_value(); }
  // Where the key's value stands; where the map does when it is absent.
  Mark mark(std::string_view key) const;
  Mark mark() const { return map_.mark(); }
  const Value& value() const { return map_; }
  std::optional<Value> find(std::string_view key) const { return map_.find(key); }

  Fields map(std::string_view key) const;  // empty when absent
  std::vector<Fields> maps(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  std::optional<double> number(std::string_view key) const;
  unsigned whole(std::string_view key, unsigned fallback) const;
  bool flag(std::string_view key, bool fallback) const;
  std::string text(std::string_view key, const std::string& fallback = {}) const;
  std::vector<std::string> texts(std::string_view key) const;
  std::vector<int> integers(std::string_view key) const;
  std::optional<math::Vec3> vector(std::string_view key) const;
  math::Vec3 vector(std::string_view key, const math::Vec3& fallback) const { return vector(key).value_or(fallback); }
  // One number for all three, or a vector.
  math::Vec3 number_or_vector(std::string_view key, const math::Vec3& fallback) const;
  math::Quat rotation(std::string_view key) const;
  std::optional<math::Pose> pose(std::string_view key) const;  // {position, orientation}

 private:
  Value map_;
};

}  // namespace ambf::adf
