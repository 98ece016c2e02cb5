// Descriptions by the rows of the table, as keys and flow values. Pure functions, any thread.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "math/types.h"
#include "scene/keys.h"

namespace ambf::adf {

using WrittenKeys = std::vector<std::pair<std::string, std::string>>;

// Keys that no row binds: their values; nullopt: the rows decide; an empty text: the key is left out.
using OwnKeys = std::function<std::optional<std::string>(const scene::Key& key)>;

std::string flow(const WrittenKeys& keys);
std::string flow(double number);
std::string flow(const math::Vec3& vector);
std::string flow(const math::Pose& pose);  // {position, orientation}
std::string flow(const std::vector<std::string>& texts);
std::string first_word(const scene::Key& key, int value);

// Of `object`, what the keys of `group` must say: what differs from `unchanged`, a description with all its defaults
// (null: that of the rows), and what is required.
WrittenKeys written_keys(const scene::Group& group, const void* object, const void* unchanged, const OwnKeys& own);

}  // namespace ambf::adf
