// All numbers of this room: what each is for, and what breaks when it is moved. docs/mesh_contacts.md has the theory
// around them. They were set by the tests named there; change one, and run tests/physics.
#pragma once

#include <cstddef>

namespace ambf::physics::detail {

// ---- What a surface is made of (feature_mesh.cpp, feature_tree.cpp). Lengths in m, angles as sines or cosines.

// Vertices closer than this are one. Larger joins real details; smaller leaves cracks, which make a solid an open
// sheet.
inline constexpr double kWeldDistance = 2e-6;
// Vertices beyond this are left out with their triangles: no body is that large, and NaN never gets in.
inline constexpr double kMaxCoordinate = 1e4;
// A surface is open when its rim is longer than this times the root of its area. Smaller: cracked solids have no
// inside; larger: bowls and plates with a hole count as solid and throw out what is in them.
inline constexpr double kOpenRimRatio = 0.5;
// Sine of the angle between faces from which an edge is convex, and from which two such edges may touch each other
// before vertices and faces do. Smaller: rounding makes edges of flat faces; larger: crossed edges fall through.
inline constexpr double kConvexEdgeSine = 1e-4, kSharpEdgeSine = 0.03;
// By so much (rad) the cone of a vertex is wider than its faces: a vertex of a flat face keeps its contacts while it
// rocks.
inline constexpr double kConeSlack = 0.02;
// From this cosine on the faces around a vertex are a smooth surface. Smaller: spheres of few triangles feel their
// edges; larger: edges of a box pass for round and are slid over.
inline constexpr float kSmoothCone = 0.95F;
// Boxes of the tree are in single precision: their extents grow by this share of the coordinates, ten times what is
// rounded off.
inline constexpr double kBoxRounding = 1e-6;

// ---- Long thin triangles (needles.cpp)

// A triangle is a needle when its height is below this (m) and its length above so many heights; none shorter than
// that (m) is divided. Coarser: shafts sink into each other between the vertices; finer: more memory and preparation
// time.
inline constexpr double kNeedleHeight = 0.001, kNeedleSlenderness = 8.0, kMinNeedleLength = 0.001;
// Sides longer than this share of the longest one are halved, in so many rounds at most.
inline constexpr double kLongSideRatio = 0.6;
inline constexpr int kMaxHalvings = 10;
// A surface with fewer needles (two of them are compared pair by pair), or with so many other triangles for each one,
// stays as it is.
inline constexpr std::size_t kMinNeedles = 40, kTrianglesPerNeedle = 200;
// Triangles that the division may add: bounds preparation to some 50 ms and 15 MB.
inline constexpr std::size_t kMaxAddedTriangles = 40000;

// ---- When features touch (feature_pair.h, surface_probe.cpp)

// How deep (m) a feature knows that it is below another. Deeper, the nearest way out may be another; smaller, fast
// bodies pass.
inline constexpr double kMaxFeatureDepth = 0.004;
// Points so far (m) beyond the edge of a face are still above it: nothing falls between two faces.
inline constexpr double kFaceOverhang = 1e-5;
// What is behind a sheet has come through it by at most this (m, or the margins if they are more), and only where it
// faces the sheet by more than this cosine. Larger depths pull walls through thin plates.
inline constexpr double kSheetDepth = 0.001, kSheetFacing = 0.2;
// Cosine up to which a vertex counts as facing a surface. Larger: the far side of a thin plate is pulled through.
inline constexpr double kFacingCosine = 0.1;
// Sine by which a direction may lean over a face next to an edge before that face is what is touched.
inline constexpr double kConeSine = 0.01;
// Cosine from which a direction is that of a face, and the distance (m) within which a point is on an edge.
inline constexpr double kFaceDirectionCosine = 0.999999, kEdgeDistance = 1e-5;
// Cosine up to which a point below a face may be beside it: above, it is outside the edge, not inside the body.
inline constexpr double kBelowCosine = 0.5;
// Faces whose nearest points have squared distances that differ by less (m^2) meet there; directions need this length
// (m).
inline constexpr double kSameSquaredDistance = 1e-14, kMinNormalLength = 1e-9;

// ---- Which contacts are found and kept (surface_contacts.cpp, contact_choice.cpp, mesh_contact_algorithm.cpp)

// Surfaces up to so far apart (m) have contacts: what a body at 2 m/s does in a step. Smaller: fast bodies arrive
// inside.
inline constexpr double kContactReach = 0.002;
// Depth reported at most (m): the push out of depth then leaves at 0.4 m/s or less. Larger: what is loaded inside is
// thrown out.
inline constexpr double kMaxReportedDepth = 0.02;
// Groups of like normals that reach the solver, and contacts of each: what a Bullet manifold holds.
inline constexpr int kMaxGroups = 4, kMaxGroupSize = 4;
// Normals of one group (a footing) have at least this cosine.
inline constexpr double kSameDirectionCosine = 0.8;
// 1 m deeper counts like so many m farther out, in the choice of a group's contacts. Smaller: bodies rock on shallow
// outer contacts; larger: the footing shrinks to its deepest points.
inline constexpr double kDepthPreference = 50.0;
// Contacts that differ by less (m) in depth, or in place, are the same one.
inline constexpr double kSameDepth = 5e-5, kSamePoint = 1e-4;
// A contact starts from the impulses of one of the last step within this distance on B (m) and cosine. Smaller:
// stacks creep.
inline constexpr double kWarmStartDistance = 0.002, kWarmStartCosine = 0.9;
// While a pair waits, its contacts slide along on flat surfaces for at most so many steps; then they stay on B.
inline constexpr std::size_t kMaxSlideInterval = 10;
// Candidates kept to choose from; of more, the deeper half.
inline constexpr std::size_t kMaxCandidates = 384;

// ---- Where there are too many triangles: bounds of one pair's work

// Pairs of triangles compared; beyond, the surfaces are searched. Triangles of a mesh in a box, and those that GJK
// meets, likewise.
inline constexpr std::size_t kMaxTrianglePairs = 512, kMaxTrianglesInBox = 1024, kMaxGjkTriangles = 128;
// Pairs of branches from which a search begins, and patches that it keeps open.
inline constexpr std::size_t kFrontierPairs = 128, kMaxOpenPatches = 1024;
// Vertices probed to find the deepest (boxes are probed so many times as many); to find the outermost in each of four
// directions; neighbours tried and moves made on the way outward. Fewer: resting bodies lose their footing for a step
// and creep.
inline constexpr std::size_t kMaxExploreProbes = 48, kBoxProbeFactor = 4, kMaxReachProbes = 6, kMaxClimbNeighbours = 12,
                             kMaxClimbMoves = 3;
// Branches and triangles that one side of a search may visit, and this share of it while many pairs are new.
inline constexpr std::size_t kMaxSearchVisits = 6000, kHurriedShare = 4;
// Groups whose outermost contacts are searched for.
inline constexpr std::size_t kFootings = 2;
// Visits of one probe, and from where on whole branches that face away are left out.
inline constexpr std::size_t kMaxProbeVisits = 300, kCullVisits = 40;
// How much the other surface may bend towards a patch, per its radius, in the bound of how deep it can be. Smaller:
// the deepest point of a round surface is missed; larger: more patches are divided than probes are left for.
inline constexpr double kBendSlack = 0.1;
// Scores that differ by less (m) are equal, and so are cones (cosines).
inline constexpr double kSameScore = 1e-7;
inline constexpr float kFlatterCone = 1e-5F;

// ---- Costs, in units of about 5 ns (15 ns on slow or busy processors), and the budget of a step (contact_budget.cpp)

inline constexpr std::size_t kPairVisitCost = 4, kFeaturePairCost = 10, kBoxTriangleCost = 5, kGjkCost = 100;
inline constexpr std::size_t kSearchVisitCost = 2, kProbeCost = 5;
// In one step all pairs together, some 0.2 ms; the last pair may exceed it. Larger: 1 kHz is lost; smaller: pairs
// wait longer.
inline constexpr std::size_t kStepBudget = 32000;
// New pairs, whose bodies may be falling, may take this much a step, out of a reserve that a tenth of kStepBudget
// fills each step.
inline constexpr std::size_t kNewPairBudget = 5 * kStepBudget, kBudgetReserve = 100 * kStepBudget;
// What the first step of a pair is expected to cost, and what is so cheap that it waits only if all such pairs are
// too many.
inline constexpr std::size_t kNewPairCost = kStepBudget / 8, kCheapCost = 200;
// Steps between two updates of a pair from which a step counts as overloaded (World::crowded_steps).
inline constexpr std::size_t kMaxUnreportedInterval = 4;

}  // namespace ambf::physics::detail
