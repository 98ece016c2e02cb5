// How a written name finds an object (ADF 1.5, 1.6): exact qualified identifier, else unique part of one. One place for
// the rule, so that loading and checking agree. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ambf::scene {

struct Lookup {
  std::optional<std::size_t> index;     // the one that is meant; none: absent, or ambiguous
  std::vector<std::size_t> candidates;  // all that contain the name, when more than one does
  bool in_world = false;                // found among the world's objects, not among the model's own
};

// `identifiers` are qualified (namespace + block identifier + conflict number). Order: exact; else the only one that
// contains `wanted`; else the only one whose part behind its namespace is `wanted`; else the only one where that part
// is a block's prefix ("BODY ") and `wanted`; else the same for `wanted` without its first slash.
Lookup find_identifier(const std::vector<std::string>& identifiers, std::string_view wanted);

// A joint's parent or child. Order: the model's own by whole name, as written or with the joint's namespace before it;
// the model's own by part; then the world's with namespace before and `conflict_number` (the number this model's
// objects got on loading, "" for none) behind, then as written.
Lookup find_joint_body(const std::vector<std::string>& own_bodies, const std::vector<std::string>& world_bodies,
                       std::string_view wanted, std::string_view joint_namespace, std::string_view conflict_number);

// Joins a header's and a block's namespace (ADF 1.3): repeated slashes collapse; a block namespace that starts with '/'
// replaces.
std::string join_namespace(std::string_view header, std::string_view block);

// The smallest of 1, 2, 3.. that makes name + number not one of `taken`; "" when the name itself is free.
std::string conflict_number(const std::vector<std::string>& taken, std::string_view name);
// Index of the one that is `name`, else of that with the shortest conflict number behind it.
std::optional<std::size_t> find_numbered(const std::vector<std::string>& identifiers, std::string_view name);

// What names the nearest of `known` by edit distance (Damerau, case and separators ignored); "" when none is near.
std::string nearest(std::string_view wanted, const std::vector<std::string>& known);

}  // namespace ambf::scene
