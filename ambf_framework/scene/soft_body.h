// The description of a soft body: a mesh whose vertices are nodes and whose edges are springs, simulated by Bullet's
// btSoftBody, or tissue of our own. Beside description.h, because few files read it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "math/types.h"
#include "scene/block_kinds.h"
#include "scene/description.h"
#include "scene/tissue.h"

namespace ambf::scene {

// The keys of `config`, named as in Bullet's btSoftBody::Config and btSoftBody::Material, which define their meaning.
// Without a unit where none is given.
struct SoftConfig {
  double kLST = 1.0, kAST = 1.0, kVST = 1.0;  // of the one material
  double kVCF = 1.0, kDP = 0.0, kDG = 0.0, kLF = 0.0;
  double kPR = 0.0;  // Pa m^3: pressure by volume
  double kVC = 0.0, kDF = 0.2, kMT = 0.0;
  double kCHR = 1.0, kKHR = 0.1, kSHR = 1.0, kAHR = 0.7;
  double kSRHR_CL = 0.1, kSKHR_CL = 1.0, kSSHR_CL = 0.5;
  double kSR_SPLT_CL = 0.5, kSK_SPLT_CL = 0.5, kSS_SPLT_CL = 0.5;
  double maxvolume = 1.0, timescale = 1.0;
  int viterations = 0, piterations = 1, diterations = 0, citerations = 4;
  int flags = 1;                        // Bullet's fCollision bits
  int bending_distance = 0;             // in links; 0: no bending links
  int clusters = -1;                    // how many; 0: one a face; -1: none
  std::vector<int> fixed_nodes;         // as the mesh file counts its vertices, from 0
  std::optional<double> inner_lattice;  // m, between nodes within a closed mesh
  std::vector<TissueRegion> regions;    // their stiffness is times kLST
};

struct SoftBody {
  Visual visual;        // follows the nodes
  Collision collision;  // its mesh, or else the visual one, gives the nodes
  double mass = 1.0;    // kg, of all nodes
  math::Pose T_model_body;
  SoftConfig config;
  bool is_tissue = false;  // then `tissue` counts, not `config`
  Tissue tissue;
  bool randomize_constraints = false;  // the solver visits the links in a shuffled order, always the same
};

namespace group {
extern const Group kSoftBody;
}

namespace kind {
extern const BlockKind kSoftBody;
}

}  // namespace ambf::scene
