#include "model/dry_load.h"

#include "mesh/cache.h"
#include "model/catalogue.h"

namespace ambf::model {

base::Diagnostics dry_load_after(const std::vector<scene::Model>& before, const scene::Model& model) {
  mesh::MeshCache meshes;
  CommandTable commands;
  CatalogueOptions options;
  options.frames = 0;
  Catalogue catalogue(options, commands, meshes);
  for (const scene::Model& each : before) catalogue.prepare_load(each);
  return catalogue.prepare_load(model).diagnostics;
}

base::Diagnostics dry_load(const scene::Model& model) { return dry_load_after({}, model); }

}  // namespace ambf::model
