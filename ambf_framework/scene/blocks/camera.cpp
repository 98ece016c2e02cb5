// A camera with its window and its pictures.
#include "scene/block_kinds.h"
#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kWindowResolutionKeys[] = {
    {.name = "width", .type = KeyType::integer, .fallback = "640", .rule = Rule::positive, .max = 8192},
    {.name = "height", .type = KeyType::integer, .fallback = "480", .rule = Rule::positive, .max = 8192},
};
constexpr Key kIntrinsicsKeys[] = {
    {.name = "fx", .type = KeyType::number, .unit = "px", .fallback = "fy", .rule = Rule::positive},
    {.name = "fy", .type = KeyType::number, .unit = "px", .fallback = "fx", .rule = Rule::positive},
    {.name = "f",
     .type = KeyType::number,
     .unit = "px",
     .fallback = "100",
     .meaning = "Both, where neither is given.",
     .rule = Rule::positive},
    {.name = "cx",
     .type = KeyType::number,
     .unit = "px",
     .fallback = "the middle",
     .meaning = "Where the camera's axis is, from the picture's left edge."},
    {.name = "cy", .type = KeyType::number, .unit = "px", .fallback = "the middle", .meaning = "From the upper edge."},
    {.name = "s",
     .type = KeyType::number,
     .unit = "px",
     .fallback = "0",
     .meaning = "Skew: what is higher is drawn further to the right. In CameraInfo, whose y goes down, -s."},
};

constexpr Key kCameraKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .member = to<&Camera::parent>(),
     .fallback = "the world",
     .meaning = "Object that it moves with; may be in another file."},
    {.name = "location",
     .type = KeyType::vector,
     .member = to<&Camera::location>(),
     .unit = "m",
     .meaning = "In the parent's frame, as look at and up."},
    {.name = "look at",
     .type = KeyType::vector,
     .member = to<&Camera::look_at>(),
     .unit = "m",
     .meaning = "Point in the middle of the view."},
    {.name = "up", .type = KeyType::vector, .member = to<&Camera::up>()},
    {.name = "clipping plane", .type = KeyType::map, .member = to<&Camera::lens>(), .sub = &kClippingPlane},
    {.name = "field view angle",
     .type = KeyType::number,
     .member = to<&Camera::lens, &state::Lens::field_of_view_rad>(),
     .unit = "rad",
     .meaning = "Vertical.",
     .rule = Rule::positive},
    {.name = "camera intrinsics",
     .type = KeyType::map,
     .fallback = "none",
     .meaning = "Since 3.0. Goes before the field view angle, which is 2 atan(height / (2 fy)), and before the "
                "projection matrix.",
     .sub = &kIntrinsics},
    {.name = "projection matrix",
     .type = KeyType::matrix,
     .fallback = "none",
     .meaning = "Since 3.0. OpenGL's, of a perspective camera, for a picture of the window resolution: goes before the "
                "field view angle and the clipping plane."},
    {.name = "orthographic view width",
     .type = KeyType::number,
     .member = to<&Camera::lens, &state::Lens::orthographic_width_m>(),
     .unit = "m",
     .fallback = "perspective",
     .meaning = "Makes the camera orthographic.",
     .rule = Rule::positive},
    {.name = "stereo",
     .type = KeyType::map,
     .member = to<&Camera::lens>(),
     .fallback = "off",
     .meaning = "Two pictures, side by side in the window.",
     .sub = &kStereo},
    {.name = "controlling devices",
     .type = KeyType::texts,
     .member = to<&Camera::controlling_devices>(),
     .fallback = "none",
     .meaning = "Names of input devices that may move it."},
    {.name = "monitor",
     .type = KeyType::integer,
     .member = to<&Camera::monitor>(),
     .meaning = "Where the window opens.",
     .rule = Rule::not_negative},
    {.name = "window resolution",
     .type = KeyType::map,
     .fallback = "640 x 480",
     .meaning = "Since 3.0. Of images without a resolution of their own, and what camera intrinsics refer to; windows "
                "open as large as the monitor allows.",
     .sub = &kWindowResolution},
    {.name = "visible",
     .type = KeyType::boolean,
     .member = to<&Camera::visible>(),
     .meaning = "false: no window; images are still published."},
    {.name = "publish image",
     .type = KeyType::boolean,
     .member = to<&Camera::image, &state::ImageStream::on>(),
     .meaning = "Topic ImageData, and what belongs to it (docs/images.md)."},
    {.name = "publish image interval",
     .type = KeyType::integer,
     .member = to<&Camera::image, &state::ImageStream::interval>(),
     .meaning = "Every n-th scene update (60 a second at most).",
     .rule = Rule::positive},
    {.name = "publish image resolution",
     .type = KeyType::map,
     .member = to<&Camera::image>(),
     .fallback = "640 x 480",
     .sub = &kResolution},
    {.name = "publish depth",
     .type = KeyType::boolean,
     .member = to<&Camera::depth, &state::ImageStream::on>(),
     .meaning = "Topics DepthData and depth/ImageData."},
    {.name = "publish depth interval",
     .type = KeyType::integer,
     .member = to<&Camera::depth, &state::ImageStream::interval>(),
     .meaning = "Every n-th scene update (60 a second at most).",
     .rule = Rule::positive},
    {.name = "publish depth resolution",
     .type = KeyType::map,
     .member = to<&Camera::depth>(),
     .fallback = "640 x 480",
     .sub = &kResolution},
    {.name = "publish depth noise",
     .type = KeyType::map,
     .member = to<&Camera::depth_noise>(),
     .fallback = "none",
     .meaning = "Gaussian, along the view.",
     .sub = &kDepthNoise},
    {.name = "preprocessing shaders",
     .type = KeyType::map,
     .meaning = "Shader pair instead of all objects' (e.g. for segmentation masks).",
     .sub = &kShaders},
    {.name = "depth compute shaders",
     .type = KeyType::map,
     .fallback = "built in",
     .meaning = "Shader pair that computes the points of DepthData and depth/ImageData (docs/rendering.md).",
     .sub = &kShaders},
    {.name = "multipass",
     .type = KeyType::boolean,
     .member = to<&Camera::multipass>(),
     .meaning = "Transparent things that cross or contain each other are seen right, at the price of more passes."},
    {.name = "mouse control multipliers", .type = KeyType::map, .member = to<&Camera::mouse>(), .sub = &kMouse},
};

constexpr Key kClippingPlaneKeys[] = {
    {.name = "near",
     .type = KeyType::number,
     .member = to<&state::Lens::near_m>(),
     .unit = "m",
     .rule = Rule::positive},
    {.name = "far", .type = KeyType::number, .member = to<&state::Lens::far_m>(), .unit = "m", .rule = Rule::positive},
};

constexpr Key kStereoKeys[] = {
    {.name = "mode", .type = KeyType::text, .meaning = "Any word: left and right picture beside each other."},
    {.name = "eye separation",
     .type = KeyType::number,
     .member = to<&state::Lens::eye_separation_m>(),
     .unit = "m",
     .rule = Rule::not_negative},
    {.name = "focal length",
     .type = KeyType::number,
     .member = to<&state::Lens::focal_length_m>(),
     .unit = "m",
     .rule = Rule::positive},
};

constexpr Key kResolutionKeys[] = {
    {.name = "width",
     .type = KeyType::integer,
     .member = to<&state::ImageStream::width>(),
     .rule = Rule::positive,
     .max = 8192,
     .required = true},
    {.name = "height",
     .type = KeyType::integer,
     .member = to<&state::ImageStream::height>(),
     .rule = Rule::positive,
     .max = 8192,
     .required = true},
};

constexpr Key kDepthNoiseKeys[] = {
    {.name = "mean", .type = KeyType::number, .member = to<&state::DepthNoise::mean>(), .unit = "m"},
    {.name = "std_dev",
     .type = KeyType::number,
     .member = to<&state::DepthNoise::std_dev>(),
     .unit = "m",
     .rule = Rule::not_negative},
    {.name = "std dev",
     .type = KeyType::number,
     .member = to<&state::DepthNoise::std_dev>(),
     .unit = "m",
     .rule = Rule::not_negative,
     .preferred = "std_dev"},
    {.name = "bias", .type = KeyType::number, .member = to<&state::DepthNoise::bias>(), .unit = "m"},
};

constexpr Key kMouseKeys[] = {
    {.name = "pan", .type = KeyType::number, .member = to<&MouseSpeed::pan>()},
    {.name = "rotate", .type = KeyType::number, .member = to<&MouseSpeed::rotate>()},
    {.name = "scroll", .type = KeyType::number, .member = to<&MouseSpeed::scroll>()},
    {.name = "arcball", .type = KeyType::number, .member = to<&MouseSpeed::arcball>()},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kCamera{.title = "camera",
                    .meaning = "A camera with its window. Vectors stand bare: `location: {x: 1, y: 0, z: 1}`.",
                    .keys = kCameraKeys,
                    .includes = kIdentityOnly,
                    .is_block = true};
const Group kWindowResolution{.title = "window resolution", .keys = kWindowResolutionKeys};
const Group kIntrinsics{
    .title = "camera intrinsics",
    .meaning =
        "A calibrated camera, for a picture of the `window resolution`; published pictures, windows "
        "and `CameraInfo` of every size follow (docs/images.md).",
    .keys = kIntrinsicsKeys};
const Group kClippingPlane{.title = "clipping plane", .keys = kClippingPlaneKeys};
const Group kStereo{.title = "stereo", .keys = kStereoKeys};
const Group kResolution{.title = "resolution", .keys = kResolutionKeys};
const Group kDepthNoise{.title = "publish depth noise", .keys = kDepthNoiseKeys};
const Group kMouse{.title = "mouse control multipliers", .keys = kMouseKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kCamera{.group = &group::kCamera,
                        .list = {.name = "cameras", .type = KeyType::texts, .meaning = "Camera blocks to load."},
                        .simulated = true};

}  // namespace ambf::scene::kind
