// From a soft body's description to its physics and its skin. Loader thread. For use inside model/kinds/soft_body*
// only.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "mesh/appearance.h"
#include "model/detail/catalogue_impl.h"
#include "physics/soft_body.h"
#include "physics/tissue.h"
#include "scene/soft_body.h"
#include "state/soft_bodies.h"

namespace ambf::model {

struct BuiltSoftBody {
  std::unique_ptr<physics::SoftBody> body;  // null: there is nothing to make nodes of, and an error said so
  state::SoftBodyInfo row;                  // less object, parent and place in the column
  // Of links: for each of row.attach_to the nodes that hang on that body, and where they are as loaded (m, world).
  std::vector<std::vector<std::uint32_t>> attached_nodes;
  std::vector<std::vector<math::Vec3>> attached_at;
};

struct SoftNodes {
  std::vector<math::Vec3> at;  // m, body frame
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> lines;
};

// The node that a number of a file's vertices means; none: there is no such vertex, or it is in no triangle or line.
class NodeNumbers {
 public:
  NodeNumbers(const scene::Collision& collision, const SoftNodes& nodes);
  std::size_t count() const { return by_file_ ? points_.size() : nodes_.at.size(); }
  std::optional<std::uint32_t> find(int number) const;

 private:
  const SoftNodes& nodes_;
  bool by_file_ = false;
  std::vector<math::Vec3> points_;
  double same_place_ = 0.0;
};

std::vector<state::SoftLink> links_of(const SoftNodes& nodes);

// Whether a point (m, body frame) is in the box or sphere of a region, or no further outside than `slack` (m).
bool is_within(const scene::TissueRegion& region, const math::Vec3& at, double slack);

// Of a block with `config`: nodes within the mesh, `size` (m) apart, and their links. What there can be none of is
// reported.
void add_inner_lattice(const scene::KindBlock& block, double size, SoftNodes& nodes, Findings& findings);

// Of tissue that can be cut: its faces, with what is within in the colour of flesh, and their skin.
std::shared_ptr<const mesh::Appearance> look_of_cuts(const physics::TissueGrid& grid,
                                                     const std::vector<math::Vec3>& points,
                                                     const mesh::Appearance* given,
                                                     std::vector<state::SkinVertex>& skin);

// Of a sheet that can be cut: what is drawn, with triangles that share no vertices, each on the nearest of its faces.
std::shared_ptr<const mesh::Appearance> look_of_cut_sheet(const std::vector<std::array<std::uint32_t, 3>>& faces,
                                                          const std::vector<math::Vec3>& points,
                                                          const mesh::Appearance& given,
                                                          std::vector<state::SkinVertex>& skin);

// Of a block with `tissue`: `nodes` are those of its collision mesh.
void build_tissue(const scene::KindBlock& block, const SoftNodes& nodes, const math::Pose& T_world_model, double step_s,
                  const std::shared_ptr<const mesh::Appearance>& appearance, Findings& findings, BuiltSoftBody& built);

// The places of a mesh's one polyline, from the end that its file names first; empty: an error said why.
std::vector<math::Vec3> polyline_of(const scene::KindBlock& block, const SoftNodes& nodes, Findings& findings);

// Of a block with `tissue` of the kind thread: along its `points`, or the polyline of `nodes`. `looks`: its material.
void build_thread(const scene::KindBlock& block, const SoftNodes& nodes, const math::Pose& T_world_model,
                  const std::shared_ptr<const mesh::Appearance>& looks, Findings& findings, BuiltSoftBody& built);

BuiltSoftBody build_soft_body(const scene::KindBlock& block, Catalogue::Impl& all, const LoadedModel& model,
                              const math::Pose& T_world_model, Findings& findings);

// What is stiffer than steps can bear is made as stiff as that, in the definition and in the body that was made of it:
// the modulus that no element exceeds then, Pa; 0: none did.
double soften(physics::TissueDefinition& definition, std::unique_ptr<physics::Tissue>& body);

}  // namespace ambf::model
