#include "adf/detail/ghost_parser.h"

#include "adf/detail/bind.h"
#include "adf/detail/body_parser.h"
#include "scene/ghost.h"

namespace ambf::adf {

std::optional<scene::KindBlock> parse_ghost(const Block& block, const FileContext& file, NameBook& names) {
  auto visual = parse_visual(block, file);
  auto collision = parse_collision(block, file);
  if (!visual || !collision) return std::nullopt;
  auto ghost = std::make_shared<scene::Ghost>(
      read<scene::Ghost>(block.fields.value(), scene::group::kGhostObject, file.options.defaults));
  ghost->visual = std::move(*visual);
  ghost->collision = std::move(*collision);
  ghost->collision.scale = ghost->visual.scale;
  return scene::KindBlock{&scene::kind::kGhostObject, parse_identity(block, file, names), std::move(ghost)};
}

}  // namespace ambf::adf
