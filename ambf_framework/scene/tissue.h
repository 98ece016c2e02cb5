// The description of tissue: what `tissue` makes of a soft body. Beside soft_body.h, because few files read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/types.h"
#include "scene/keys.h"

namespace ambf::scene {

enum class TissueKind { solid, thread, sheet };
// What the surface of tissue meets of tissue: its own (lips of cuts, folds) and others; others; nothing.
enum class TissueTouches { all, others, none };

// A part of the tissue that differs from the rest.
struct TissueRegion {
  std::optional<math::Vec3> box;  // m, full lengths
  double sphere = 0.0;            // m, its radius; 0: none
  std::vector<int> vertices;      // as the mesh file counts them, from 0
  math::Pose location;            // of box or sphere, in the body frame
  bool fixed = false;
  double density = 1.0, stiffness = 1.0;  // times that of the rest
  std::string attach_to;                  // empty: none
};

struct TissueRelaxation {
  double share = 1.0;  // of a stress that stays
  double time = 1.0;   // s
};

struct Tissue {
  TissueKind kind = TissueKind::solid;
  double young = 5000.0;  // Pa
  double poisson = 0.45;
  double density = 1060.0;             // kg/m^3
  std::optional<double> element_size;  // m
  TissueRelaxation relaxation;
  double friction = 0.4;
  TissueTouches touches = TissueTouches::all;
  int max_nodes = 0;                // 0: it cannot be cut
  double radius = 0.0002;           // m, of threads
  std::optional<double> thickness;  // m, of sheets
  std::vector<math::Vec3> points;   // m, body frame: a thread's polyline
  std::vector<TissueRegion> regions;
};

namespace group {
extern const Group kTissue, kTissueRegion, kTissueRelaxation, kThreadPoint;
}

}  // namespace ambf::scene
