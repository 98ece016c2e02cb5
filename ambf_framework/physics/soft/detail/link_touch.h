// Contacts of soft bodies of links with tissue. Private to physics/soft/. Physics thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "physics/detail/bullet.h"

namespace ambf::physics::detail {

struct SoftData;
struct TissueData;

// Of a node on a face of tissue, or of a point of tissue on a face of nodes.
struct LinkHold {
  const void* with = nullptr;  // the tissue, or the body of links, that it touches; null: none
  bool front = true;           // of a sheet, or of nodes: on the side that the normal of the face points to
  // Of a node: the face that was the nearest in the last step, and which way was out.
  std::uint32_t near = 0;
  btVector3 normal{0, 0, 0};
  // Where on the face it is held: friction pulls it back there (EQUATIONS 17).
  std::uint32_t face = 0;
  std::array<double, 3> share{};
  btVector3 off{0, 0, 0};     // m, of the nodes from there
  bool slid = false;          // in the last step: it is held anew, as far off
  btVector3 pushed{0, 0, 0};  // Ns, on the nodes in the last step: the next begins with it
  btVector3 borne{0, 0, 0};   // Ns, in a step, that the tissue has come to bear: its motion has that in it
};

// The place on the tissue is the sum of these corners, that on the links of these nodes, each by its weight.
struct FaceContact {
  static constexpr std::size_t kMaxCorners = 12, kMaxNodes = 3;
  struct Node {
    btVector3* x;        // m, as it is being solved
    const btVector3* q;  // m, as the step began
    double weight;
    double yield;  // m/Ns, of the node for what is pushed at the place
  };

  TissueData* tissue;
  LinkHold* hold;
  std::array<Node, kMaxNodes> node;
  std::array<std::uint32_t, kMaxCorners> corner;
  std::array<double, kMaxCorners> weight;
  std::size_t nodes, corners;
  btVector3 normal;      // out of the tissue
  double offset, depth;  // m, along the normal: of the surface, margin included; and how far behind it the nodes may be
  double impulse;        // Ns/m, that moves nodes and surface apart
  double friction;
  btVector3 back;    // m, across the normal, that the nodes are to come back in the step
  btVector3 pushed;  // Ns, on the nodes in the step
  bool slides;

  btVector3 now() const {
    btVector3 sum(0, 0, 0);
    for (std::size_t k = 0; k < nodes; ++k) sum += *node[k].x * node[k].weight;
    return sum;
  }
  btVector3 before() const {
    btVector3 sum(0, 0, 0);
    for (std::size_t k = 0; k < nodes; ++k) sum += *node[k].q * node[k].weight;
    return sum;
  }
};

// Elements, beyond what they keep apart: what is no further may come back, and what it has borne is remembered.
constexpr double kStays = 0.1;

// What is the nearest to a node, or to a point, in one search.
struct NearFace {
  bool found = false;
  std::uint32_t face = 0;
  std::array<double, 3> share{};  // of its corners
  bool front = true;
  double away = 0.0;  // m: of a node, how far, or within which it is to be; of a point, how far in front of the face
};

// Of each node the nearest face of tissue; of each point of tissue the nearest of those faces of nodes that are not
// much smaller than its elements (links/link_search.cpp). `keep`: m, how far apart they are to be.
void find_faces(SoftData& links, const TissueData& tissue, double keep);
bool find_points(const SoftData& links, TissueData& tissue, double keep);  // false: there are no such faces

}  // namespace ambf::physics::detail
