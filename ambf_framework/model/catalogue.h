// All that is loaded, seen from the loader: names and ids, models with their descriptions, lineage. It builds what a
// structural change needs (shapes, bodies, joints, controllers, a new Structure, frames) so that the physics thread
// only has to link it in. Loader thread only, except where said. Every Prepared with success must be applied, in order:
// the catalogue has already moved on.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/limits.h"
#include "model/command_table.h"
#include "model/prepared.h"
#include "scene/description.h"
#include "state/structure.h"

namespace ambf::mesh {
class MeshCache;  // mesh/cache.h
}

namespace ambf::model {

struct ParentChange;  // model/saved_state.h

struct CatalogueOptions {
  std::string world_namespace;   // of the world file, e.g. "/ambf/env/"; cameras, lights and topics of the world
  std::string namespace_prefix;  // put before every namespace (--ns)
  std::optional<double> rate_low_hz, rate_high_hz;  // replace every object's publishing rates
  double step_s = 0.001;                            // controller gains are judged by it
  std::size_t frames = base::kFramesPerPool;  // to make for what is loaded; without any it is checked, not simulated
};

struct LoadOptions {
  std::string name_prefix;   // put before the model's namespaces
  math::Pose T_world_model;  // where the model is put
  bool environment = false;  // ModelInfo::environment
  // By block, numbers behind the names of its objects that they get where these are free.
  std::map<std::string, std::string> conflict_numbers = {};
};

class Catalogue {
 public:
  // `commands` must outlive the catalogue; `meshes` too.
  Catalogue(CatalogueOptions options, CommandTable& commands, mesh::MeshCache& meshes);
  ~Catalogue();
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;

  // The newest made, applied or not. Never null; empty at first.
  std::shared_ptr<const state::Structure> structure() const;

  // The world file's own objects (model 0), with a default camera and a default light where it has none. Once, before
  // all else.
  Prepared prepare_world(const scene::World& world);
  Prepared prepare_load(const scene::Model& model, const LoadOptions& options = {});
  // What prepare_load would say now: as it would go, into a copy of what is here that is thrown away. Changes nothing.
  base::Diagnostics check_load(const scene::Model& model, const LoadOptions& options = {}) const;
  // By ModelInfo::name. Joints of other models to its bodies go too.
  Prepared prepare_unload(const std::string& model);
  // One object by state::find's rules. The joints of a removed body go too.
  Prepared prepare_remove(const std::string& object);

  // Gives an object of a kind with a parent the one that `parent` names, by the rules of the ADF key; empty: the world.
  Prepared prepare_set_parent(state::ObjectId object, const std::string& parent);

  // What a snapshot says of parents (decode() has let it pass). Where they are in the world stays as it is.
  Prepared prepare_parents(const std::vector<ParentChange>& changes);
  // All objects hang as their files say, and are where that puts them. No success when they do already.
  Prepared prepare_parents_as_loaded();

  // The description that a model was made from, less the objects removed since; null when there is none.
  const scene::Model* description(state::ModelId model) const;

  // What the objects of a model are made from, in the structure's order.
  struct Made {
    std::uint32_t object = state::kNone;  // index into Structure::objects
    std::string block;                    // its identifier in the description
  };
  std::vector<Made> made_from(state::ModelId model) const;
  // What LoadOptions::conflict_numbers must say, by model, for all models but `without` to come back under the names
  // that they have when they are loaded again in this order: of objects that would get other numbers.
  std::map<state::ModelId, std::map<std::string, std::string>> numbers_to_keep(
      const std::set<state::ModelId>& without) const;

  struct Impl;  // model/detail/catalogue_impl.h: for kinds (model/kinds/)

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::model
