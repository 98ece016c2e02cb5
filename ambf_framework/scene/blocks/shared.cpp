// Keys that several kinds of block share: identity, poses, shaders, plugins.
#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kIdentityKeys[] = {
    {.name = "name",
     .type = KeyType::text,
     .fallback = "the block's key",
     .meaning = "Name in topics and windows; spaces are removed."},
    {.name = "namespace",
     .type = KeyType::text,
     .fallback = "the file's",
     .meaning = "Appended to the file's namespace; replaces it when it starts with '/'."},
    {.name = "passive",
     .type = KeyType::boolean,
     .member = to<&Identity::passive>(),
     .meaning = "No topics; a passive joint is not listed by its bodies."},
    {.name = "publish frequency",
     .type = KeyType::map,
     .unit = "Hz",
     .fallback = "50 to 1000",
     .meaning = "Rate of the State topic: idle, and while the object is commanded.",
     .sub = &kRates},
    {.name = "plugins",
     .type = KeyType::maps,
     .meaning = "Libraries to load with it.",
     .sub = &kPlugin,
     .status = KeyStatus::later},
};

constexpr Key kRatesKeys[] = {
    {.name = "low",
     .type = KeyType::number,
     .member = to<&Identity::rate_low_hz>(),
     .unit = "Hz",
     .meaning = "Idle.",
     .rule = Rule::positive},
    {.name = "high",
     .type = KeyType::number,
     .member = to<&Identity::rate_high_hz>(),
     .unit = "Hz",
     .meaning = "Commanded.",
     .rule = Rule::positive},
};

constexpr Key kPoseKeys[] = {
    {.name = "position", .type = KeyType::vector, .unit = "m", .fallback = "0"},
    {.name = "orientation", .type = KeyType::rotation, .unit = "rad", .fallback = "0"},
};

constexpr Key kPluginKeys[] = {
    {.name = "name", .type = KeyType::text, .required = true},
    {.name = "filename", .type = KeyType::text, .meaning = "Library, e.g. libexample.so.", .required = true},
    {.name = "path", .type = KeyType::folder, .meaning = "Folder of the library, from this file's folder."},
};

constexpr Key kGeometryDataKeys[] = {
    {.name = "input type", .type = KeyType::text, .fallback = "triangles"},
    {.name = "output type", .type = KeyType::text, .fallback = "triangle_strip"},
    {.name = "max vertices out", .type = KeyType::integer, .fallback = "3", .rule = Rule::positive},
};

constexpr Key kShadersKeys[] = {
    {.name = "path",
     .type = KeyType::folder,
     .meaning = "Folder of the shaders, from this file's folder.",
     .required = true},
    {.name = "vertex", .type = KeyType::file, .required = true},
    {.name = "fragment", .type = KeyType::file, .required = true},
    {.name = "geometry",
     .type = KeyType::file,
     .meaning = "Since 3.0. The other two run without it.",
     .status = KeyStatus::later},
    {.name = "geometry data", .type = KeyType::map, .meaning = "Since 3.0.", .sub = &kGeometryData},
};

constexpr Key kGainsKeys[] = {
    {.name = "P", .type = KeyType::number_or_vector, .member = to<&ChannelGains::p>(), .meaning = "On the error."},
    {.name = "I", .type = KeyType::number_or_vector, .member = to<&ChannelGains::i>(), .meaning = "On its integral."},
    {.name = "D", .type = KeyType::number_or_vector, .member = to<&ChannelGains::d>(), .meaning = "On its derivative."},
};

}  // namespace

const Group kIdentity{.title = "every block", .meaning = "Keys of every block.", .keys = kIdentityKeys};
const Group kRates{.title = "publish frequency", .keys = kRatesKeys};
const Group kPose{.title = "pose", .meaning = "Orientation: R = Rz(y) Ry(p) Rx(r).", .keys = kPoseKeys};
const Group kPlugin{
    .title = "plugins", .meaning = "Each plugin may have further keys of its own.", .keys = kPluginKeys, .open = true};
const Group kShaders{.title = "shaders", .keys = kShadersKeys};
const Group kGeometryData{.title = "geometry data", .meaning = "Of a geometry shader.", .keys = kGeometryDataKeys};
const Group kGains{.title = "gains", .meaning = "One number, or one for each axis.", .keys = kGainsKeys};

}  // namespace ambf::scene::group
