// A light.
#include <numbers>

#include "scene/block_kinds.h"
#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kLightKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .member = to<&Light::parent>(),
     .fallback = "the world",
     .meaning = "Object that it moves with; may be in another file."},
    {.name = "location",
     .type = KeyType::vector,
     .member = to<&Light::location>(),
     .unit = "m",
     .meaning = "In the parent's frame."},
    {.name = "direction",
     .type = KeyType::vector,
     .member = to<&Light::direction>(),
     .meaning = "In the parent's frame."},
    {.name = "spot exponent",
     .type = KeyType::number,
     .member = to<&Light::beam, &state::Beam::spot_exponent>(),
     .meaning = "All lights are spot lights.",
     .rule = Rule::not_negative},
    {.name = "cutoff angle",
     .type = KeyType::number,
     .member = to<&Light::beam, &state::Beam::cutoff_angle_rad>(),
     .unit = "rad",
     .rule = Rule::positive,
     .max = std::numbers::pi},
    {.name = "shadow quality",
     .type = KeyType::integer,
     .member = to<&Light::beam, &state::Beam::shadow_quality>(),
     .meaning = "0: none.",
     .rule = Rule::not_negative,
     .max = 5},
    {.name = "attenuation",
     .type = KeyType::map,
     .member = to<&Light::beam>(),
     .meaning = "By distance.",
     .sub = &kAttenuation},
};

constexpr Key kAttenuationKeys[] = {
    {.name = "constant",
     .type = KeyType::number,
     .member = to<&state::Beam::attenuation_constant>(),
     .rule = Rule::not_negative},
    {.name = "linear",
     .type = KeyType::number,
     .member = to<&state::Beam::attenuation_linear>(),
     .rule = Rule::not_negative},
    {.name = "quadratic",
     .type = KeyType::number,
     .member = to<&state::Beam::attenuation_quadratic>(),
     .rule = Rule::not_negative},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kLight{
    .title = "light", .meaning = "A spot light.", .keys = kLightKeys, .includes = kIdentityOnly, .is_block = true};
const Group kAttenuation{.title = "attenuation", .keys = kAttenuationKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kLight{.group = &group::kLight,
                       .list = {.name = "lights", .type = KeyType::texts, .meaning = "Light blocks to load."},
                       .simulated = true};

}  // namespace ambf::scene::kind
