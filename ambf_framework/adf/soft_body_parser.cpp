#include "adf/detail/soft_body_parser.h"

#include <string>

#include "adf/detail/bind.h"
#include "adf/detail/body_parser.h"
#include "scene/soft_body.h"

namespace ambf::adf {

namespace {

constexpr int kNodesMeetBodies = 0x1, kClustersMeetBodies = 0x2, kMeetsBodies = 0xf;
constexpr int kKnownFlags = 0x73;  // those of btSoftBody; the others are of Bullet's deformable bodies

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
  explain(block.fields, soft->config, file.report);
  return scene::KindBlock{&scene::kind::kSoftBody, parse_identity(block, file, names), std::move(soft)};
}

}  // namespace ambf::adf
