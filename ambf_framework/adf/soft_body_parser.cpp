#include "adf/detail/soft_body_parser.h"

#include <initializer_list>
#include <limits>
#include <string>

#include "adf/detail/bind.h"
#include "adf/detail/body_parser.h"
#include "scene/soft_body.h"

namespace ambf::adf {

namespace {

constexpr int kNodesMeetBodies = 0x1, kClustersMeetBodies = 0x2, kMeetsBodies = 0xf;
constexpr int kKnownFlags = 0x73;  // those of btSoftBody; the others are of Bullet's deformable bodies

// Shares by which Bullet corrects or brakes: beyond 1 it overshoots, below 0 it goes the other way.
void report_ranges(const Fields& fields, const scene::SoftConfig& config, Report& report) {
  struct Share {
    const char* key;
    double value, highest;
  };
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const Share& share :
       {Share{"kLST", config.kLST, 1.0}, Share{"kDP", config.kDP, 1.0}, Share{"kMT", config.kMT, 1.0},
        Share{"kDF", config.kDF, kNone}, Share{"kCHR", config.kCHR, 1.0}, Share{"kKHR", config.kKHR, 1.0},
        Share{"kSHR", config.kSHR, 1.0}})
    if (share.value < 0.0 || share.value > share.highest)
      report.warning(fields.mark(share.key), std::string("config/") + share.key,
                     (share.highest == kNone ? "expected at least 0, found " : "expected 0 to 1, found ") +
                         scene::text_of(share.value),
                     "it is used as it is, and the body will most likely diverge");
  if (config.piterations == 0)
    report.warning(fields.mark("piterations"), "config/piterations",
                   "0 sweeps: neither links nor contacts hold anything", "give 1 or more");
}

// What Bullet does by these settings may surprise: nothing is changed.
void explain(const Fields& fields, const scene::SoftConfig& config, Report& report) {
  const Mark mark = fields.map("config").mark("flags");
  const int meets = config.flags & kMeetsBodies;
  if ((config.flags & ~kKnownFlags) != 0) {
    report.warning(mark, "config/flags",
                   "the bits " + std::to_string(config.flags & ~kKnownFlags) +
                       " are of Bullet's deformable bodies and mean nothing here",
                   "1: nodes meet bodies; 2: clusters meet bodies; 16: nodes meet soft bodies; 32, 64: clusters meet "
                   "soft bodies, themselves");
  } else if (meets != kNodesMeetBodies && meets != kClustersMeetBodies) {
    report.information(mark, "config/flags", "of value " + std::to_string(config.flags) + " they let it meet no bodies",
                       "add 1 and its nodes meet them");
  }
  if ((config.flags & 0x62) != 0 && config.clusters < 0) {
    report.warning(mark, "config/flags", "clusters are to meet something, but there are none",
                   "give `clusters`, or leave out the bits 2, 32 and 64");
  }
}

bool check_region(const Fields& fields, const std::string& path, scene::TissueRegion& region, Report& report) {
  region.vertices = fields.integers("vertices");
  const int shapes = (region.box ? 1 : 0) + (region.sphere > 0.0 ? 1 : 0) + (fields.has("vertices") ? 1 : 0);
  if (shapes != 1) {
    report.error(fields.mark(), path + "box",
                 "expected one of `box`, `sphere` and `vertices`, found " + std::to_string(shapes),
                 "say where the region is; it is left out");
    return false;
  }
  if (!region.fixed && region.attach_to.empty() && region.density == 1.0 && region.stiffness == 1.0)
    report.warning(fields.mark(), path + "fixed", "the region changes nothing",
                   "give `fixed`, `density`, `stiffness` or `attach to`");
  return true;
}

void warn_of(const Fields& fields, std::initializer_list<const char*> keys, const char* of, Report& report) {
  for (const char* key : keys)
    if (fields.has(key))
      report.warning(fields.mark(key), std::string("tissue/") + key, std::string("has no effect on ") + of,
                     "tissue.md says what is of which `kind`");
}

void read_regions(const Fields& fields, const std::string& of, const FileContext& file,
                  std::vector<scene::TissueRegion>& to) {
  const std::vector<Fields> regions = fields.maps("regions");
  for (std::size_t i = 0; i < regions.size(); ++i) {
    auto region = read<scene::TissueRegion>(regions[i].value(), scene::group::kTissueRegion, file.options.defaults);
    if (check_region(regions[i], of + "/regions[" + std::to_string(i) + "]/", region, file.report))
      to.push_back(std::move(region));
  }
}

// False: there is nothing to make a thread of. Without `points`, the polyline of a mesh, `has_mesh`, is read at load.
bool read_points(const Fields& block, bool has_mesh, scene::Tissue& tissue, Report& report) {
  const Fields fields = block.map("tissue");
  if (!fields.has("points") && has_mesh) return true;
  for (const char* key : {"mesh", "collision mesh"})
    if (block.has(key))
      report.warning(block.mark(key), key, "has no effect on a thread with `points`", "give one of both");
  double length = 0.0;
  for (const Fields& each : fields.maps("points")) {
    for (const char* axis : {"x", "y", "z"})
      if (!each.has(axis))
        report.warning(each.mark(), std::string("tissue/points/") + axis, "missing: it counts as 0", "give it");
    const math::Vec3 at{each.number("x", 0.0), each.number("y", 0.0), each.number("z", 0.0)};
    if (!tissue.points.empty()) length += math::norm(at - tissue.points.back());
    tissue.points.push_back(at);
  }
  if (tissue.points.size() >= 2 && length > 0.0) return true;
  report.error(
      fields.has("points") ? fields.mark("points") : fields.mark(), "tissue/points",
      "expected at least two places that differ, found " + std::to_string(tissue.points.size()),
      "give the thread as [{x, y, z}, {x, y, z}] in the body frame, or a `mesh` with a polyline (`l` in an OBJ "
      "file); the soft body is left out");
  return false;
}

// False: nothing sensible can be made of it.
bool check_tissue(const Fields& block, bool has_mesh, const FileContext& file, scene::Tissue& tissue) {
  const Fields fields = block.map("tissue");
  const bool is_thread = tissue.kind == scene::TissueKind::thread;
  if (is_thread) {
    warn_of(fields, {"poisson ratio", "relaxation", "max nodes", "thickness"}, "threads", file.report);
    if (!read_points(block, has_mesh, tissue, file.report)) return false;
  } else {
    const bool is_sheet = tissue.kind == scene::TissueKind::sheet;
    warn_of(fields, {"points", "radius"}, is_sheet ? "sheets" : "solids", file.report);
    if (!is_sheet) warn_of(fields, {"thickness"}, "solids", file.report);
    if (is_sheet && !tissue.thickness) {
      file.report.error(fields.mark(), "tissue/thickness", "missing: a sheet has one, above 0",
                        "give it in metres: peritoneum 1e-4 to 5e-4, skin 1e-3 to 2e-3; the soft body is left out");
      return false;
    }
  }
  if (!is_thread && tissue.poisson >= 0.5) {
    file.report.error(fields.mark("poisson ratio"), "tissue/poisson ratio",
                      "expected a number below 0.5, found " + scene::text_of(tissue.poisson),
                      "tissue that hardly changes its volume has 0.45 to 0.49; the soft body is left out");
    return false;
  }
  for (const char* key : {"config", "mass", "randomize constraints"})
    if (block.has(key))
      file.report.warning(block.mark(key), key, "has no effect on tissue", "`tissue` says what it is made of");
  if (is_thread)
    for (const Fields& region : fields.maps("regions"))
      warn_of(region, {"density", "stiffness", "vertices"}, "threads", file.report);
  read_regions(fields, "tissue", file, tissue.regions);
  return true;
}

}  // namespace

std::optional<scene::KindBlock> parse_soft_body(const Block& block, const FileContext& file, NameBook& names) {
  auto visual = parse_visual(block, file);
  auto collision = parse_collision(block, file);
  if (!visual || !collision) return std::nullopt;
  auto soft = std::make_shared<scene::SoftBody>(
      read<scene::SoftBody>(block.fields.value(), scene::group::kSoftBody, file.options.defaults));
  soft->visual = std::move(*visual);
  soft->collision = std::move(*collision);
  soft->collision.scale = soft->visual.scale;
  soft->config.fixed_nodes = block.fields.map("config").integers("fixed nodes");
  soft->is_tissue = block.fields.has("tissue");
  if (soft->is_tissue) {
    if (!check_tissue(block.fields, !soft->collision.mesh_file.empty(), file, soft->tissue)) return std::nullopt;
  } else {
    explain(block.fields, soft->config, file.report);
    report_ranges(block.fields.map("config"), soft->config, file.report);
    read_regions(block.fields.map("config"), "config", file, soft->config.regions);
  }
  return scene::KindBlock{&scene::kind::kSoftBody, parse_identity(block, file, names), std::move(soft)};
}

}  // namespace ambf::adf
