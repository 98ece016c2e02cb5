// Tissue of our own: solids of tetrahedra and sheets of triangles whose stiffness is a modulus, not a setting
// (docs/tissue.md). A Tissue is a SoftBody whose nodes are points of its surface; those of a solid lie in a coarse grid
// of tetrahedra, whose corners move, those of a sheet are the corners. Made off the physics thread; once in a world
// only the physics thread may call anything here. SI units, world axes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "math/types.h"
#include "physics/soft_body.h"

namespace ambf::physics {

class Body;

namespace detail {
struct TissueData;
}

struct TissueMaterial {
  double young = 5000.0;    // Pa, > 0
  double poisson = 0.45;    // 0 to below 0.5
  double density = 1060.0;  // kg/m^3, > 0
  double friction = 0.4;    // times the body's
  double share = 1.0;       // of a stress that stays when it has relaxed
  double time = 1.0;        // s, in which the rest of it falls to 1/e
};

struct TissueElement {
  std::array<std::uint32_t, 4> corner{};  // of a positive volume
  double share = 1.0;                     // of its volume that is tissue
  double stiffness = 1.0, density = 1.0;  // times the material's
};

// Of a sheet.
struct TissueTriangle {
  std::array<std::uint32_t, 3> corner{};
  double stiffness = 1.0, density = 1.0;  // times the material's
};

// A point in a tetrahedron: the sum of the corners, each by its weight.
struct TissuePoint {
  std::array<std::uint32_t, 4> corner{};
  std::array<double, 4> weight{};  // they add up to 1
  std::uint32_t element = 0;       // whose corners these are
};

// A face between two elements, or an edge between two triangles of a sheet, which a cut may open.
struct TissueSeam {
  std::array<std::uint32_t, 2> element{};
  // Of 0 to 3 of each, those at one place in one order; of triangles two.
  std::array<std::array<std::uint8_t, 3>, 2> corner{};
};

struct TissueGrid {
  std::vector<math::Vec3> corners;  // m, body frame
  std::vector<TissueElement> elements;
  std::vector<TissuePoint> points;                  // of the surface: the nodes of the soft body
  std::vector<std::array<std::uint32_t, 3>> faces;  // of points
  double element_size = 0.0;                        // m
  std::vector<TissueTriangle> triangles;            // of a sheet, instead of elements: then points are corners
  double thickness = 0.0;                           // m, of a sheet
  // Of what can be cut (empty: it cannot): each face above is of points of one element. Behind those of the surface
  // come, of a solid, two faces for each seam, one of either side, which are hidden until it is open.
  std::vector<TissueSeam> seams;
  std::size_t first_inner_face = 0, first_inner_point = 0;
};

struct TissueDefinition {
  TissueGrid grid;
  TissueMaterial material;
  math::Pose T_world_body;
  double margin = 0.001;                              // m, how far from a surface points, and sides of a sheet, stay
  double step_s = 0.001;                              // that the number of iterations is chosen for
  std::vector<std::uint32_t> fixed;                   // corners that only carry_fixed() moves
  std::vector<std::vector<std::uint32_t>> attached;   // groups of corners that hang on a body each
  std::vector<int> collision_groups;                  // as BodyDefinition has them
  std::size_t max_corners = 0;                        // as cuts make them more; below what it begins with: no cuts
  bool touches_itself = true, touches_others = true;  // a solid's surface meets that of itself, of other solids
};

class Tissue final : public SoftBody {
 public:
  static constexpr std::size_t kFurtherTouches = 2048;  // of tissue, in a step, besides two of each point
  static constexpr std::size_t kMaxTips = 128;          // places of bodies that touch faces at once

  explicit Tissue(const TissueDefinition& definition);
  ~Tissue() override;

  std::size_t node_count() const override;
  std::size_t link_count() const override;  // elements, or triangles
  const std::vector<std::array<std::uint32_t, 3>>& faces() const override;
  double mass() const override;
  math::Vec3 position(std::size_t node) const override;
  math::Vec3 velocity(std::size_t node) const override;
  bool fixed(std::size_t node) const override;
  bool has_fixed() const override;
  math::Pose centre() const override;

  void apply_force(std::size_t node, const math::Vec3& force) override;
  void apply_wrench(const math::Wrench& wrench) override;
  void carry_fixed(const math::Pose& T_world_body, double max_speed) override;

  void reset() override;
  void get_state(std::vector<double>& out) const override;
  bool set_state(std::span<const double> state) override;
  std::size_t state_size() const override;
  std::optional<SoftDivergence> divergence(const SpeedLimits& limits = {}) const override;
  void freeze() override;
  bool frozen() const override;

  // The body that a group of `attached` hangs on from now on; null: none. It holds them where they are on it when both
  // are as loaded.
  void attach(std::size_t group, Body* body);
  std::size_t attached_groups() const;
  std::size_t iterations() const;         // of each step's solver
  std::size_t wanted_iterations() const;  // more than there are: it is stiffer than steps can solve exactly
  double volume() const;                  // m^3, of its tissue as deformed; sheets keep their thickness
  bool is_sheet() const;
  std::size_t corner_count() const;            // grows as it is cut
  std::size_t open_seams() const;              // faces between elements that were cut
  std::size_t pieces() const;                  // that it is in
  std::vector<std::size_t> cut_nodes() const;  // those on the surface of cuts, that outside of it included
  bool full() const;                           // a cut was left out, for want of room
  bool can_be_cut() const;
  std::size_t contacts() const;                 // points, and tips, that touched something in the last step
  std::size_t tips() const;                     // of these, tips and edges of bodies that touched faces
  std::size_t touches() const;                  // between its surface and that of itself or other tissue, likewise
  bool touches_left_out() const;                // there were more of these, or of tips, than there is room for
  math::Vec3 force_on(const Body& body) const;  // N, world: what it did to a body in the last step
  math::Vec3 momentum() const;                  // Ns
  math::Vec3 angular_momentum() const;          // Nms, about its centre

  detail::TissueData* tissue() const override { return tissue_.get(); }

 private:
  std::unique_ptr<detail::TissueData> tissue_;
};

}  // namespace ambf::physics
