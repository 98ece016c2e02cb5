#include "model/dry_load.h"

#include "mesh/cache.h"
#include "model/catalogue.h"

namespace ambf::model {

base::Diagnostics dry_load(const scene::Model& model) {
  mesh::MeshCache meshes;
  CommandTable commands;
  CatalogueOptions options;
  options.frames = false;
  Catalogue catalogue(options, commands, meshes);
  return catalogue.prepare_load(model).diagnostics;
}

}  // namespace ambf::model
