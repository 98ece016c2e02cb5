// Body blocks (ADF 4, 9). One thread.
#pragma once

#include "adf/detail/file_context.h"
#include "scene/description.h"

namespace ambf::adf {

// The block has passed the table of keys; none when something in it is wrong beyond that.
std::optional<scene::Body> parse_body(const Block& block, const FileContext& file, NameBook& names);

// Its parts; each reports what it leaves out.
std::optional<scene::Visual> parse_visual(const Block& block, const FileContext& file);
std::optional<scene::Collision> parse_collision(const Block& block, const FileContext& file);
// The colours of a body, or of an item of a compound; `identifier`, that of the body, makes random ones repeat, `path`
// stands before the keys in what is reported. None: the mesh's own.
std::optional<scene::Material> parse_material(const Fields& fields, const std::string& identifier,
                                              const std::string& path, const FileContext& file);
// `shape` and `geometry` of a body, or of an item of a compound.
std::optional<scene::Geometry> parse_geometry(const Fields& shape_owner, std::string_view shape_key,
                                              std::string_view geometry_key, const std::string& path, Report& report);
// A mesh file that a key names: `file` found, or resolved when nobody looks; "" and an error when it is not there.
struct MeshPath {
  std::string file;
  std::vector<std::string> candidates;
};
enum class MeshFolder { high_resolution, low_resolution };
// Where a mesh may be that a block names, best first: the block's own path instead of the header's, then header + own
// path (ruling Q9).
std::vector<std::string> mesh_places(const Fields& block, const std::string& mesh, MeshFolder folder,
                                     const FileContext& file);
MeshPath find_mesh(const Fields& block, std::string_view key, MeshFolder folder, const FileContext& file);

// A list of placed shapes and meshes; none when one of them is wrong. Of a mesh that is not there, an error is said.
struct Compound {
  std::vector<scene::PlacedGeometry> shapes;
  std::vector<scene::PlacedMesh> meshes;
};
std::optional<Compound> parse_compound(const Block& block, std::string_view key, MeshFolder folder,
                                       const FileContext& file);

}  // namespace ambf::adf
