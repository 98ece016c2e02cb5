// Private to mesh/: materials, effects and images of a COLLADA document.
#pragma once

#include <map>
#include <string>

#include "mesh/formats/detail/collada_document.h"
#include "mesh/formats/read_context.h"

namespace ambf::mesh {

class ColladaMaterials {
 public:
  ColladaMaterials(const ColladaDocument& xml, ReadContext& context, RawMesh& out)
      : xml_(xml), context_(context), out_(out) {}

  // Index into RawMesh::materials of what `reference` names, read on first use; -1 with one warning when there is none.
  std::int32_t index_of(const std::string& reference);

 private:
  void read_effect(ColladaDocument::Node effect, Material& material);
  void read_color(ColladaDocument::Node technique, const char* name, Color& color, std::string* texture,
                  ColladaDocument::Node profile);
  void read_opacity(ColladaDocument::Node technique, Material& material) const;
  std::string texture_of(ColladaDocument::Node profile, const std::string& name);

  const ColladaDocument& xml_;
  ReadContext& context_;
  RawMesh& out_;
  std::map<std::string, std::int32_t> known_;
};

}  // namespace ambf::mesh
