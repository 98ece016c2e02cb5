// What the catalogue knows of each object, and the steps of which its changes are made; shared by its source files. For
// use inside model/ only; loader thread.
#pragma once

#include <any>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/catalogue.h"
#include "model/detail/body_builder.h"
#include "model/detail/findings.h"
#include "model/detail/lineage.h"
#include "model/detail/live_objects.h"
#include "model/detail/names.h"
#include "model/detail/swap.h"

namespace ambf::model {

// One object, alive as long as the catalogue counts it in; the live object itself belongs to the physics thread.
struct Entry {
  state::ObjectInfo info;       // slot: in the newest structure, state::kNone before the first
  std::string identifier;       // of its block in the description
  std::string own_identifier;   // qualified, without conflict number: how its own file calls it
  std::string conflict_number;  // behind identifier and name
  std::string name_space;       // with prefixes

  std::any row;  // of its kind's table, less what only a structure knows: indices and slots
  template <class Row>
  Row& row_as() {
    return std::any_cast<Row&>(row);
  }
  template <class Row>
  const Row& row_as() const {
    return std::any_cast<const Row&>(row);
  }

  // Bodies. The pointer is only handed on to joints, never dereferenced.
  physics::Body* physics_body = nullptr;
  physics::Joint* physics_joint = nullptr;  // joints; likewise, handed on to those that follow it
  Entry* followed = nullptr;                // joints with a mimic
  double scale = 1.0;
  Entry* parent = nullptr;  // joints: body; kinds with a parent: null is the world
  Entry* child = nullptr;   // joints: body
  // Kinds with a parent.
  std::string wanted_parent;  // as written; empty: the world
  std::string loaded_parent;  // the same, as its file has it
  Reparenting reparenting = Reparenting::none;

  // New since the newest structure: the live object on its way to the physics thread.
  std::unique_ptr<LiveObject> live;
};

struct LoadedModel {
  state::ModelInfo info;
  scene::Model description;
  std::set<std::string> defaults;  // identifiers of blocks that no file describes
};

// What hangs below a body, as its row says it.
struct Relatives {
  state::IndexList children, joints;
};

struct Catalogue::Impl {
  Impl(CatalogueOptions given, CommandTable& table, mesh::MeshCache& mesh_cache);

  // Steps of loading (catalogue_load.cpp).
  const state::ModelInfo& load(const scene::Model& description, const LoadOptions& options, Findings& findings);
  Entry* add_entry(state::ObjectKind kind, const scene::Identity& identity, state::ModelId model,
                   const std::string& name_space, Findings& findings);
  std::string full_namespace(const scene::Identity& identity, const LoadOptions& options) const;
  Entry* find_body(const std::string& wanted, const Entry& joint, const char* key, const scene::Identity& at,
                   Findings& findings) const;
  // The joint that another one follows, by the rules of find_body; null when there is none or several.
  Entry* find_joint(const std::string& wanted, const Entry& follower) const;
  // What an object may hang on under this name; null when there is none or several.
  Entry* find_parent(const Entry& placed, const std::string& wanted) const;
  // Reports where an object hangs, when that is not what its file says.
  void report_parent(const Entry& placed, const scene::Identity& at, Findings& findings) const;
  // From now on; `change` says what becomes of its pose.
  static void hang(Entry& placed, Entry* parent, const std::string& as_written, Reparenting change);
  // Gives objects that miss their parent the one that was loaded.
  void find_missing_parents();
  void report_parents(const scene::Model& described, state::ModelId model, Findings& findings) const;
  bool hangs_on(const Entry* entry, const Entry* ancestor) const;

  // Removing (catalogue.cpp): these and the joints to removed bodies.
  void remove(const std::vector<Entry*>& leaving);

  // Makes this empty one look like another: names, lineage, and entries with bodies that are mere masses
  // (catalogue_check.cpp).
  void stand_in_for(const Impl& other, std::vector<std::unique_ptr<physics::Body>>& masses);

  // The new structure and the swap that leads to it, from the entries as they are now (catalogue_structure.cpp).
  Prepared finish(std::string model, base::Diagnostics diagnostics);
  std::shared_ptr<state::Structure> build_structure();
  std::vector<Relatives> list_relatives(const std::vector<Entry*>& by_index,
                                        const std::vector<std::uint32_t>& object_of) const;
  Prepared refuse(const std::string& message, const std::string& hint = {}) const;

  CatalogueOptions options;
  CommandTable& commands;
  mesh::MeshCache& meshes;
  BodyBuilder bodies;
  Names names;
  Lineage lineage;
  std::vector<std::unique_ptr<LoadedModel>> models;       // in load order; the world first
  std::vector<std::unique_ptr<Entry>> entries;            // in load order
  std::unordered_map<std::string, Entry*> loaded_bodies;  // of the model loaded last, by own_identifier
  std::map<std::string, std::string> wanted_numbers;      // of the model that is loaded, by block
  std::vector<std::pair<state::ObjectKind, std::uint32_t>> removed_slots;  // of the newest structure, since it was made
  std::vector<std::uint32_t> generations;   // by ObjectId::index: of the next object with it
  std::vector<std::uint32_t> free_indices;  // reused last in, first out
  state::ModelId next_model = 1;
  std::shared_ptr<const state::WorldLook> look = std::make_shared<const state::WorldLook>();
  math::Vec3 gravity;  // m/s^2, of the world file
  std::shared_ptr<const state::Structure> newest;
};

}  // namespace ambf::model
