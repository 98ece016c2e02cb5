#include "scene/detail/keys_internal.h"

namespace ambf::scene::table {

namespace {

constexpr Key kCameraKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .fallback = "the world",
     .meaning = "Object that it moves with; may be in another file."},
    {.name = "location",
     .type = KeyType::vector,
     .unit = "m",
     .fallback = "0",
     .meaning = "In the parent's frame, as look at and up."},
    {.name = "look at",
     .type = KeyType::vector,
     .unit = "m",
     .fallback = "0",
     .meaning = "Point in the middle of the view."},
    {.name = "up", .type = KeyType::vector, .fallback = "0, 0, 1", .meaning = {}},
    {.name = "clipping plane", .type = KeyType::map, .meaning = {}, .sub = Group::clipping_plane},
    {.name = "field view angle",
     .type = KeyType::number,
     .unit = "rad",
     .fallback = "0.7",
     .meaning = "Vertical.",
     .rule = Rule::positive},
    {.name = "orthographic view width",
     .type = KeyType::number,
     .unit = "m",
     .fallback = "perspective",
     .meaning = "Makes the camera orthographic.",
     .rule = Rule::positive},
    {.name = "stereo",
     .type = KeyType::map,
     .fallback = "off",
     .meaning = "Two pictures, side by side in the window.",
     .sub = Group::stereo},
    {.name = "controlling devices",
     .type = KeyType::texts,
     .fallback = "none",
     .meaning = "Names of input devices that may move it."},
    {.name = "monitor",
     .type = KeyType::integer,
     .fallback = "0",
     .meaning = "Where the window opens.",
     .rule = Rule::not_negative},
    {.name = "visible",
     .type = KeyType::boolean,
     .fallback = "true",
     .meaning = "false: no window; images are still published."},
    {.name = "publish image",
     .type = KeyType::boolean,
     .fallback = "false",
     .meaning = "Topic ImageData, and what belongs to it (docs/images.md)."},
    {.name = "publish image interval",
     .type = KeyType::integer,
     .fallback = "1",
     .meaning = "Every n-th scene update (60 a second at most).",
     .rule = Rule::positive},
    {.name = "publish image resolution",
     .type = KeyType::map,
     .fallback = "640 x 480",
     .meaning = {},
     .sub = Group::resolution},
    {.name = "publish depth",
     .type = KeyType::boolean,
     .fallback = "false",
     .meaning = "Topics DepthData and depth/ImageData."},
    {.name = "publish depth interval",
     .type = KeyType::integer,
     .fallback = "10",
     .meaning = "Every n-th scene update (60 a second at most).",
     .rule = Rule::positive},
    {.name = "publish depth resolution",
     .type = KeyType::map,
     .fallback = "640 x 480",
     .meaning = {},
     .sub = Group::resolution},
    {.name = "publish depth noise",
     .type = KeyType::map,
     .fallback = "none",
     .meaning = "Gaussian, along the view.",
     .sub = Group::depth_noise},
    {.name = "preprocessing shaders",
     .type = KeyType::map,
     .meaning = "Shader pair instead of all objects' (e.g. for segmentation masks).",
     .sub = Group::shaders},
    {.name = "depth compute shaders",
     .type = KeyType::map,
     .fallback = "built in",
     .meaning = "Shader pair that computes the points of DepthData and depth/ImageData (docs/rendering.md).",
     .sub = Group::shaders},
    {.name = "multipass",
     .type = KeyType::boolean,
     .fallback = "false",
     .meaning = "Transparent things that cross or contain each other are seen right, at the price of more passes."},
    {.name = "mouse control multipliers", .type = KeyType::map, .meaning = {}, .sub = Group::mouse},
};

constexpr Key kLightKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .fallback = "the world",
     .meaning = "Object that it moves with; may be in another file."},
    {.name = "location",
     .type = KeyType::vector,
     .unit = "m",
     .fallback = "0, 0, 5",
     .meaning = "In the parent's frame."},
    {.name = "direction", .type = KeyType::vector, .fallback = "0, 0, -1", .meaning = "In the parent's frame."},
    {.name = "spot exponent",
     .type = KeyType::number,
     .fallback = "0.7",
     .meaning = "All lights are spot lights.",
     .rule = Rule::not_negative},
    {.name = "cutoff angle",
     .type = KeyType::number,
     .unit = "rad",
     .fallback = "0.7",
     .meaning = {},
     .rule = Rule::positive},
    {.name = "shadow quality",
     .type = KeyType::integer,
     .fallback = "0",
     .meaning = "0 (none) to 5.",
     .rule = Rule::not_negative},
    {.name = "attenuation", .type = KeyType::map, .meaning = "By distance.", .sub = Group::attenuation},
};

constexpr Key kClippingPlaneKeys[] = {
    {.name = "near", .type = KeyType::number, .unit = "m", .fallback = "0.1", .rule = Rule::positive},
    {.name = "far", .type = KeyType::number, .unit = "m", .fallback = "10", .rule = Rule::positive},
};
constexpr Key kStereoKeys[] = {
    {.name = "mode", .type = KeyType::text, .meaning = "Any word: left and right picture beside each other."},
    {.name = "eye separation", .type = KeyType::number, .unit = "m", .fallback = "0.2", .rule = Rule::not_negative},
    {.name = "focal length", .type = KeyType::number, .unit = "m", .fallback = "0.5", .rule = Rule::positive},
};
constexpr Key kResolutionKeys[] = {
    {.name = "width", .type = KeyType::integer, .fallback = "640", .rule = Rule::positive, .required = true},
    {.name = "height", .type = KeyType::integer, .fallback = "480", .rule = Rule::positive, .required = true},
};
constexpr Key kDepthNoiseKeys[] = {
    {.name = "mean", .type = KeyType::number, .unit = "m", .fallback = "0.1"},
    {.name = "std_dev", .type = KeyType::number, .unit = "m", .fallback = "0.001", .rule = Rule::not_negative},
    {.name = "std dev", .type = KeyType::number, .unit = "m", .meaning = "The same.", .rule = Rule::not_negative},
    {.name = "bias", .type = KeyType::number, .unit = "m", .fallback = "0"},
};
constexpr Key kMouseKeys[] = {
    {.name = "pan", .type = KeyType::number, .fallback = "1"},
    {.name = "rotate", .type = KeyType::number, .fallback = "1"},
    {.name = "scroll", .type = KeyType::number, .fallback = "1"},
    {.name = "arcball", .type = KeyType::number, .fallback = "1"},
};
constexpr Key kAttenuationKeys[] = {
    {.name = "constant", .type = KeyType::number, .fallback = "1", .rule = Rule::not_negative},
    {.name = "linear", .type = KeyType::number, .fallback = "0", .rule = Rule::not_negative},
    {.name = "quadratic", .type = KeyType::number, .fallback = "0", .rule = Rule::not_negative},
};

constexpr Group kIncludes[] = {Group::identity};

}  // namespace

const GroupInfo kCamera{.group = Group::camera,
                        .title = "camera",
                        .meaning = "A camera with its window. Vectors stand bare: `location: {x: 1, y: 0, z: 1}`.",
                        .keys = kCameraKeys,
                        .includes = kIncludes,
                        .is_block = true};
const GroupInfo kLight{.group = Group::light,
                       .title = "light",
                       .meaning = "A spot light.",
                       .keys = kLightKeys,
                       .includes = kIncludes,
                       .is_block = true};
const GroupInfo kClippingPlane{
    .group = Group::clipping_plane, .title = "clipping plane", .meaning = {}, .keys = kClippingPlaneKeys};
const GroupInfo kStereo{.group = Group::stereo, .title = "stereo", .meaning = {}, .keys = kStereoKeys};
const GroupInfo kResolution{.group = Group::resolution, .title = "resolution", .meaning = {}, .keys = kResolutionKeys};
const GroupInfo kDepthNoise{
    .group = Group::depth_noise, .title = "publish depth noise", .meaning = {}, .keys = kDepthNoiseKeys};
const GroupInfo kMouse{.group = Group::mouse, .title = "mouse control multipliers", .meaning = {}, .keys = kMouseKeys};
const GroupInfo kAttenuation{
    .group = Group::attenuation, .title = "attenuation", .meaning = {}, .keys = kAttenuationKeys};

}  // namespace ambf::scene::table
