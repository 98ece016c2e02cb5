// A volume of voxels: checked, not simulated yet.
#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kVolumeKeys[] = {
    {.name = "parent", .type = KeyType::text, .meaning = "Object that it sits on; may be in another file."},
    {.name = "location", .type = KeyType::map, .sub = &kPose},
    {.name = "scale", .type = KeyType::number, .fallback = "1"},
    {.name = "images", .type = KeyType::map, .sub = &kImages},
    {.name = "dimensions", .type = KeyType::vector, .unit = "m", .fallback = "1"},
    {.name = "iso-surface value", .type = KeyType::number, .fallback = "0.5"},
    {.name = "optical density", .type = KeyType::number, .fallback = "1"},
    {.name = "quality", .type = KeyType::number, .fallback = "0.5"},
    {.name = "color lut", .type = KeyType::file, .meaning = "Since 3.0. Picture of one row: colours by value."},
    {.name = "shaders", .type = KeyType::map, .sub = &kShaders},
};

constexpr Key kImagesKeys[] = {
    {.name = "path", .type = KeyType::folder},
    {.name = "prefix", .type = KeyType::text},
    {.name = "format", .type = KeyType::text},
    {.name = "count", .type = KeyType::integer},
};

constexpr const Group* kColored[] = {&kIdentity, &kColor};

}  // namespace

const Group kVolume{
    .title = "volume", .meaning = "Not simulated yet.", .keys = kVolumeKeys, .includes = kColored, .is_block = true};
const Group kImages{.title = "images", .keys = kImagesKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kVolume{.group = &group::kVolume,
                        .list = {.name = "volumes", .type = KeyType::texts, .meaning = "Volume blocks."}};

}  // namespace ambf::scene::kind
