// The header of a launch file.
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kLaunchKeys[] = {
    {.name = "adf version",
     .type = KeyType::text,
     .fallback = "1.0",
     .meaning =
         "Version of the format. Only 1.0 exists; a file that names another one is refused. Upper case is accepted."},
    {.name = "world config", .type = KeyType::file, .fallback = "a default world", .meaning = "World file."},
    {.name = "color config",
     .type = KeyType::file,
     .fallback = "no names",
     .meaning = "Colour file: names for `color`."},
    {.name = "input devices config", .type = KeyType::file, .fallback = "none", .meaning = "Input devices file."},
    {.name = "multibody configs",
     .type = KeyType::texts,
     .fallback = "none",
     .meaning = "Model files; `-l 0,3` loads by place in this list. An empty text leaves its place empty."},
    {.name = "world configs",
     .type = KeyType::texts,
     .fallback = "`world config` for all",
     .meaning = "A world file for each of `multibody configs`: the first entry of -l takes its own instead of `world "
                "config`. Not known to the original."},
    {.name = "multibody placements",
     .type = KeyType::maps,
     .fallback = "as the model files say",
     .meaning = "Where each of `multibody configs` is put; {} for one that is put nowhere else. Not known to the "
                "original.",
     .sub = &kPlacement},
    {.name = "plugins",
     .type = KeyType::maps,
     .meaning = "Libraries to load with it.",
     .sub = &kPlugin,
     .status = KeyStatus::later},
};

constexpr Key kPlacementKeys[] = {
    {.name = "name prefix",
     .type = KeyType::text,
     .fallback = "none",
     .meaning = "Put before the model's namespaces, e.g. /left."},
    {.name = "location",
     .type = KeyType::map,
     .fallback = "the origin",
     .meaning = "Pose of the model's origin in the world.",
     .sub = &kPose},
};

}  // namespace

const Group kPlacement{.title = "multibody placements", .keys = kPlacementKeys};
const Group kLaunch{.title = "launch file",
                    .meaning = "The top level of a launch file. Paths start at its folder.",
                    .keys = kLaunchKeys,
                    .is_header = true};

}  // namespace ambf::scene::group
