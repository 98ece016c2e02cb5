// A point cloud of AMBF 3.0, drawn from a topic: checked, not simulated yet.
#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kPointCloudKeys[] = {
    {.name = "parent", .type = KeyType::text, .meaning = "Object in whose frame the points are."},
    {.name = "points size", .type = KeyType::number, .fallback = "0.01"},
    {.name = "shaders", .type = KeyType::map, .sub = &kShaders},
};

constexpr const Group* kColored[] = {&kIdentity, &kColor};

}  // namespace

const Group kPointCloud{.title = "point cloud",
                        .meaning = "Since 3.0. Not simulated yet.",
                        .keys = kPointCloudKeys,
                        .includes = kColored,
                        .is_block = true};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kPointCloud{
    .group = &group::kPointCloud,
    .list = {.name = "point clouds", .type = KeyType::texts, .meaning = "Since 3.0. Point cloud blocks."}};

}  // namespace ambf::scene::kind
