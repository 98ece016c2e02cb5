// Private to mesh/: faces and lines from the corners of COLLADA's kinds of primitives. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "mesh/formats/raw_mesh.h"

namespace ambf::mesh {

class ColladaFaces {
 public:
  ColladaFaces(ReadContext& context, RawMesh& out) : context_(context), out_(out) {}

  // `kind`: the primitive's element, "triangles", "tristrips", ...; `vcount`: corners of each face of a polylist;
  // `mirrored`: placed by a transform that turns faces inside out, so that their corners are taken the other way round;
  // `line`: of the file, for messages. False after context.fail().
  bool add(std::string_view kind, const std::vector<RawCorner>& corners, const std::vector<std::uint32_t>& vcount,
           std::int32_t material, bool mirrored, int line);

 private:
  bool add_face(const RawCorner* corners, std::size_t count, std::int32_t material, bool mirrored);

  ReadContext& context_;
  RawMesh& out_;
  std::size_t triangles_ = 0;
};

}  // namespace ambf::mesh
