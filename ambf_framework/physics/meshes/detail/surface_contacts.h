// Finds where the surface of a mesh touches another surface, a box or another convex shape, and chooses few points
// that say as much as all. Contacts are those of features: vertices with faces, sharp edges with sharp edges, each
// once, and only where the directions say that they are outermost. That is some ten times cheaper than treating every
// pair of triangles as two bodies, and knows the right direction a few millimetres deep. Work is bounded: where too
// many triangles are near each other, PatchSearch looks for the deepest and the outermost vertices instead. Keeps its
// storage; one world's physics thread. Knows no bodies. Private to physics/.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "physics/meshes/detail/contact_budget.h"
#include "physics/meshes/detail/feature_mesh.h"
#include "physics/meshes/detail/patch_search.h"
#include "physics/meshes/detail/surface_preparation.h"

namespace ambf::physics::detail {

// A vertex of one of two meshes.
struct SurfaceVertex {
  int vertex = -1;
  bool of_a = true;
};

// In the frame of B.
struct SurfaceContact {
  btVector3 point;            // on B's surface, margin included
  btVector3 normal;           // unit, from B to A
  double distance;            // m, between the surfaces, margins included; negative: depth
  SurfaceVertex vertex = {};  // that found it, in a search
};

class SurfaceContacts {
 public:
  struct Pair {
    int a, b;
  };

  SurfaceContacts();

  // Start anew with one of these. `reach`: contacts up to this distance. `fine`: whether there were too many
  // triangles the last time, kept by the caller. `known`: vertices that touched then.
  void touch(const FeatureMesh& a, const FeatureMesh& b, const btTransform& T_b_a, double reach, bool& fine,
             std::span<const SurfaceVertex> known);
  void touch(const FeatureMesh& a, const btConvexShape& b, const btTransform& T_b_a, double reach);
  // A contact known from before counts, too, unless one was found there.
  void add_old(const SurfaceContact& contact);

  // At most kMaxGroupSize contacts of each of at most kMaxGroups groups, in the order of the groups' depth.
  struct Chosen {
    SurfaceContact contact;
    int group;
  };
  const std::vector<Chosen>& choose();

  // Surfaces that a search needs are prepared there from now on, and searched as they are until they are ready; null
  // (the default): touch() prepares them itself, so that what it finds does not depend on the clock.
  void prepare_by(SurfacePreparation* preparation) { preparation_ = preparation; }

  std::size_t cost() const { return cost_; }  // of the last touch(), in some 5 ns
  ContactBudget& budget() { return budget_; }

 private:
  struct Near {
    int node;
    double distance;
  };
  struct Frame;

  const FeatureMesh& searched(const FeatureMesh& mesh) const;
  bool find_pairs(const FeatureMesh& a, const FeatureMesh& b, const Frame& frame, double reach, std::size_t max);
  bool find_triangles(const FeatureMesh& a, const btVector3& centre, const btVector3& half);
  // `hurried`: with less care, because there are many new pairs.
  void search(const FeatureMesh& a, const FeatureMesh& b, const btTransform& T_b_a, double reach, bool hurried,
              std::span<const SurfaceVertex> known);
  void search_solid(const FeatureMesh& a, const btVector3& half, const btTransform& T_b_a, double reach,
                    std::span<const SurfaceVertex> known);
  struct Side;
  template <class Probe>
  void search_side(const Side& side, Probe probe);
  void find_near(const FeatureMesh& a, const btConvexShape& b, const btTransform& T_b_a, double reach);
  void keep_nearest(std::vector<Near>& all, std::size_t max);
  void touch_solid(const FeatureMesh& a, const btVector3& half, const Frame& frame, double reach,
                   std::span<const SurfaceVertex> known);
  void add(const btVector3& point, const btVector3& normal, double distance, SurfaceVertex vertex = {});
  void choose_group(int group, const SurfaceContact& deepest);

  std::vector<Pair> pairs_, next_, found_;
  std::vector<Pair> frontier_;  // near pairs of branches, few enough to begin a search with
  std::vector<int> begin_;      // with these nodes of one mesh
  std::vector<OpenPatch> open_;
  std::vector<Near> near_, nearer_, leaves_;
  std::vector<SurfaceContact> contacts_;
  std::vector<int> group_of_;
  std::vector<Chosen> chosen_;
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver depths_;
  std::size_t cost_ = 0;
  SurfacePreparation* preparation_ = nullptr;
  ContactBudget budget_;
};

}  // namespace ambf::physics::detail
