// Private to mesh/: the sources of COLLADA primitives (positions, normals, texture coordinates), read into a RawMesh
// and placed in the scene; and what the parts of the COLLADA reader share. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesh/formats/detail/collada_document.h"
#include "mesh/formats/detail/collada_transform.h"
#include "mesh/formats/raw_mesh.h"
#include "mesh/formats/read_context.h"

namespace ambf::mesh {

// One file being read. Instances can repeat each other exponentially: all reading is paid from one budget of
// characters.
class ColladaTask {
 public:
  ColladaTask(const ColladaDocument& xml, ReadContext& context) : xml_(xml), context_(context) {}

  // False after context.fail() when the budget is used up.
  bool spend(std::size_t characters);
  bool fail_at(const ColladaDocument::Node& node, const std::string& message);  // always false

 private:
  const ColladaDocument& xml_;
  ReadContext& context_;
  std::size_t spent_ = 0;
};

// One geometry placed in the scene.
struct ColladaGeometry {
  using FirstIndices = std::map<const void*, std::uint32_t>;  // source element -> its first index in the RawMesh

  Matrix T_scene_geometry;
  ColladaDocument::Node mesh;
  std::map<std::string, std::string> materials;  // symbol -> material reference
  FirstIndices positions, normals, texcoords;
};

// The sources that one primitive refers to, and where in each of its corners their indices are.
struct ColladaInputs {
  std::size_t stride = 1;
  std::size_t position_at = 0, normal_at = 0, texcoord_at = 0;
  ColladaDocument::Node position_source, normal_source, texcoord_source;
};

class ColladaSources {
 public:
  ColladaSources(const ColladaDocument& xml, ColladaTask& task, ReadContext& context, RawMesh& out)
      : xml_(xml), task_(task), context_(context), out_(out) {}

  // Each false after context.fail().
  bool read_inputs(ColladaDocument::Node primitive, ColladaInputs& out);
  bool place(const ColladaInputs& inputs, ColladaGeometry& geometry);  // sources that are not in the RawMesh yet
  // The corner of that number among the indices `p` of a primitive. `node` is where messages point to.
  bool to_corner(const std::vector<std::uint32_t>& p, std::size_t corner, const ColladaInputs& inputs,
                 const ColladaGeometry& geometry, RawCorner& out, ColladaDocument::Node node);

 private:
  bool read_source(ColladaDocument::Node source, std::size_t width, std::vector<float>& into, std::size_t& out_count);
  bool place_positions(ColladaDocument::Node source, ColladaGeometry& geometry);
  bool place_normals(ColladaDocument::Node source, ColladaGeometry& geometry);

  const ColladaDocument& xml_;
  ColladaTask& task_;
  ReadContext& context_;
  RawMesh& out_;
};

}  // namespace ambf::mesh
