// Private to mesh/: materials, effects and images of a COLLADA document.
#pragma once

#include <map>
#include <string>

#include "mesh/formats/detail/xml.h"
#include "mesh/formats/read_context.h"

namespace ambf::mesh {

// Elements by their `id`, whatever they are; the first of equal ids counts.
class ColladaIds {
 public:
  explicit ColladaIds(const XmlTree& xml);
  // The element `name` a reference like "#id" means (the '#' may be missing); XmlTree::kNone when there is none.
  std::uint32_t find(const std::string& reference, std::string_view name) const;

 private:
  const XmlTree& xml_;
  std::map<std::string, std::uint32_t, std::less<>> by_id_;
};

class ColladaMaterials {
 public:
  ColladaMaterials(const XmlTree& xml, const ColladaIds& ids, ReadContext& context, RawMesh& out)
      : xml_(xml), ids_(ids), context_(context), out_(out) {}

  // Index into RawMesh::materials of what `reference` names, read on first use; -1 with one warning when there is none.
  std::int32_t index_of(const std::string& reference);

 private:
  void read_effect(std::uint32_t effect, Material& material);
  void read_color(std::uint32_t technique, const char* name, Color& color, std::string* texture, std::uint32_t profile);
  void read_opacity(std::uint32_t technique, Material& material) const;
  std::string texture_of(std::uint32_t profile, const std::string& name);

  const XmlTree& xml_;
  const ColladaIds& ids_;
  ReadContext& context_;
  RawMesh& out_;
  std::map<std::string, std::int32_t> known_;
};

}  // namespace ambf::mesh
