// The kinds of objects, as one table: built-in kinds are its first entries, plugins and tests append theirs. Code asks
// the table what a kind can do instead of naming kinds. Register before the first world is made
// (docs/decisions/0020-kinds.md); the table is read-only from then on, so that every thread reads it without a lock.
// C++17.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "state/ids.h"

namespace ambf::state {

class KindRows;  // state/kind_rows.h: a kind's rows in structures and frames

struct KindInfo {
  std::string name;        // unique identifier, as services and files spell it: "rigid_body"
  std::string label;       // singular, as lists, logs and messages call one: "body"
  std::string plural;      // "bodies"
  bool has_topics = true;  // its objects have a pair of topics and take commands
  bool has_parent = true;  // its objects have a pose in a parent (another object or the world) that can be exchanged
  bool has_mass = false;   // its objects are rigid bodies: joints connect them, forces act on them
  bool connects_bodies = false;  // its objects are joints
};

// Appends a kind. Throws std::logic_error when the name is taken, and once the first world was made. Not thread-safe:
// from main(), from a static initializer, or while a plugin is loaded.
ObjectKind register_kind(KindInfo info, std::unique_ptr<KindRows> rows);

// All kinds, the world (0) included, have the numbers 0 .. kind_count() - 1, in the order of registration.
std::size_t kind_count();
const KindInfo& info_of(ObjectKind kind);
std::optional<ObjectKind> find_kind(const std::string& name);

// visit(ObjectKind, const KindInfo&) for each kind of object, in the order of registration; the world is none.
template <class Visit>
void for_each_kind(Visit&& visit) {
  for (std::size_t i = 1; i < kind_count(); ++i) visit(static_cast<ObjectKind>(i), info_of(static_cast<ObjectKind>(i)));
}

// Called when the first world is made: kinds and columns can no longer be registered.
void close_registration();
// Throws std::logic_error when registration is closed.
void require_open_registration(const std::string& name);

}  // namespace ambf::state
