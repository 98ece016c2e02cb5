#include "scene/detail/keys_internal.h"

namespace ambf::scene::table {

namespace {

constexpr std::string_view kShapes =
    "Box|box|BOX|Sphere|sphere|SPHERE|Cylinder|cylinder|CYLINDER|Capsule|capsule|CAPSULE|Cone|cone|CONE|Plane|plane|"
    "PLANE";
constexpr std::string_view kLeftOut = "the shape is left out";
constexpr std::string_view kOutputs = "FORCE|force|EFFORT|effort|VELOCITY|velocity|POSITION|position";

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
     .fallback = "false",
     .meaning = "No topics; a passive joint is not listed by its bodies."},
    {.name = "publish frequency",
     .type = KeyType::map,
     .unit = "Hz",
     .fallback = "50 to 1000",
     .meaning = "Rate of the State topic: idle, and while the object is commanded.",
     .sub = Group::rates},
    {.name = "plugins",
     .type = KeyType::maps,
     .meaning = "Libraries to load with it.",
     .sub = Group::plugin,
     .status = KeyStatus::later},
};

constexpr Key kRatesKeys[] = {
    {.name = "low",
     .type = KeyType::number,
     .unit = "Hz",
     .fallback = "50",
     .meaning = "Idle.",
     .rule = Rule::positive},
    {.name = "high",
     .type = KeyType::number,
     .unit = "Hz",
     .fallback = "1000",
     .meaning = "Commanded.",
     .rule = Rule::positive},
};

constexpr Key kVisualKeysList[] = {
    {.name = "mesh",
     .type = KeyType::file,
     .fallback = "none",
     .meaning = "Visual mesh, in the high resolution path. '' means none."},
    {.name = "mesh remove duplicates",
     .type = KeyType::boolean,
     .fallback = "false",
     .meaning = "Equal vertices of meshes are always welded; the key changes nothing."},
    {.name = "shape",
     .type = KeyType::choice,
     .fallback = "none",
     .meaning = "Visual primitive; needs `geometry`. Goes before `compound shape`, and that before `mesh`.",
     .choices = kShapes,
     .instead = kLeftOut},
    {.name = "geometry", .type = KeyType::map, .meaning = "Sizes of `shape`.", .sub = Group::geometry},
    {.name = "compound shape",
     .type = KeyType::maps,
     .meaning = "Several visual primitives.",
     .sub = Group::placed_shape},
    {.name = "high resolution path",
     .type = KeyType::folder,
     .fallback = "the file's",
     .meaning = "Folder of the visual mesh, instead of the file's. Where the mesh is not there, file's path + this "
                "path is tried."},
    {.name = "low resolution path",
     .type = KeyType::folder,
     .fallback = "the block's high resolution path, else the file's",
     .meaning = "Folder of the collision mesh, likewise."},
    {.name = "visible", .type = KeyType::boolean, .fallback = "true", .meaning = "Whether it is drawn."},
    {.name = "scale",
     .type = KeyType::number,
     .fallback = "1",
     .meaning = "Multiplies visual and collision meshes and shapes, and the joint pivots on this body.",
     .rule = Rule::positive},
    {.name = "shaders",
     .type = KeyType::map,
     .fallback = "the file's, else the world's",
     .meaning = "Shader pair.",
     .sub = Group::shaders},
};

constexpr Key kCollisionKeysList[] = {
    {.name = "collision margin",
     .type = KeyType::number,
     .unit = "m",
     .fallback = "0.001",
     .meaning = {},
     .rule = Rule::not_negative},
    {.name = "collision groups",
     .type = KeyType::integers,
     .fallback = "none",
     .meaning =
         "0 to 999. Among bodies with groups, only those that share one collide; a body without collides with all."},
    {.name = "collision shape",
     .type = KeyType::choice,
     .fallback = "none",
     .meaning = "Collision primitive; needs `collision geometry`. Before `compound collision shape`, `collision mesh`, "
                "`mesh`.",
     .choices = kShapes,
     .instead = kLeftOut},
    {.name = "collision geometry",
     .type = KeyType::map,
     .meaning = "Sizes of `collision shape`.",
     .sub = Group::geometry},
    {.name = "collision offset",
     .type = KeyType::map,
     .fallback = "inertial offset",
     .meaning = "Pose of `collision shape` or of the collision mesh in the body.",
     .sub = Group::pose},
    {.name = "compound collision shape",
     .type = KeyType::maps,
     .meaning = "Several collision primitives, placed in the body.",
     .sub = Group::placed_shape},
    {.name = "collision mesh", .type = KeyType::file, .fallback = "mesh", .meaning = "In the low resolution path."},
    {.name = "collision mesh type",
     .type = KeyType::choice,
     .fallback = "CONCAVE_MESH",
     .meaning = "What is made of the collision mesh: its hull; a convex shape of its vertices; its triangles; a sphere "
                "of radius `collision "
                "margin` at each vertex.",
     .choices =
         "CONVEX_HULL|convex_hull|hull|CONVEX_MESH|convex_mesh|TRIMESH|trimesh|CONCAVE_MESH|POINT_CLOUD|point_cloud",
     .instead = "CONCAVE_MESH is used"},
};

constexpr Key kColorKeysList[] = {
    {.name = "use material",
     .type = KeyType::boolean,
     .fallback = "true",
     .meaning = "false: the mesh's own colours, whatever stands below."},
    {.name = "color rgba",
     .type = KeyType::map,
     .meaning = "One colour, 0 to 1. Goes before `color components`.",
     .sub = Group::color_rgba},
    {.name = "color components",
     .type = KeyType::map,
     .meaning = "All parts of the material.",
     .sub = Group::color_components},
    {.name = "color",
     .type = KeyType::text_or_map,
     .fallback = "the mesh's own",
     .meaning =
         "A name of the colour file, or random (the same at each start). Used when neither of the above is given.",
     .sub = Group::color_rgba},
};

constexpr Key kBodyKeys[] = {
    {.name = "mass",
     .type = KeyType::number,
     .unit = "kg",
     .fallback = "1",
     .meaning = "0: static.",
     .rule = Rule::not_negative},
    {.name = "inertia",
     .type = KeyType::map,
     .unit = "kg m^2",
     .fallback = "of the collision shape",
     .meaning = "Principal, at the centre of mass.",
     .sub = Group::inertia},
    {.name = "inertial offset",
     .type = KeyType::map,
     .fallback = "mean of the collision mesh's vertices; none for primitives",
     .meaning = "Pose of the centre of mass in the body.",
     .sub = Group::pose},
    {.name = "gravity",
     .type = KeyType::vector,
     .unit = "m/s^2",
     .fallback = "the file's, else the world's",
     .meaning = {}},
    {.name = "location",
     .type = KeyType::map,
     .fallback = "the origin",
     .meaning = "Pose of the body (its mesh) in the world.",
     .sub = Group::pose},
    {.name = "friction", .type = KeyType::map, .meaning = "Bullet's coefficients.", .sub = Group::friction},
    {.name = "restitution", .type = KeyType::number, .fallback = "0.1", .meaning = {}, .rule = Rule::not_negative},
    {.name = "damping",
     .type = KeyType::map,
     .meaning = "Part of the velocity that is lost in a second.",
     .sub = Group::body_damping},
    {.name = "controller",
     .type = KeyType::map,
     .fallback = "velocity with P = 10, D = 1",
     .meaning = "Cartesian controller. A channel that is given has FORCE as output, the other one stays at VELOCITY.",
     .sub = Group::cartesian_controller},
    {.name = "controller output type",
     .type = KeyType::choice,
     .meaning = "Output of both channels; read with `controller` only.",
     .choices = kOutputs,
     .instead = "FORCE is used"},
    {.name = "publish children names", .type = KeyType::boolean, .fallback = "false", .meaning = "In the State topic."},
    {.name = "publish joint names", .type = KeyType::boolean, .fallback = "true", .meaning = "In the State topic."},
    {.name = "publish joint positions",
     .type = KeyType::boolean,
     .fallback = "true",
     .meaning = "In the State topic; velocities and efforts too."},
    {.name = "inertial offset undef", .type = KeyType::text, .status = KeyStatus::ignored},
    {.name = "resistive surface",
     .type = KeyType::map,
     .meaning = "Rays that feel and resist, one a triangle.",
     .sub = Group::resistive_surface,
     .status = KeyStatus::later},
};

constexpr Key kPoseKeys[] = {
    {.name = "position", .type = KeyType::vector, .unit = "m", .fallback = "0"},
    {.name = "orientation", .type = KeyType::rotation, .unit = "rad", .fallback = "0"},
};

constexpr Key kGeometryKeys[] = {
    {.name = "x", .type = KeyType::number, .unit = "m", .meaning = "box: full length", .rule = Rule::not_negative},
    {.name = "y", .type = KeyType::number, .unit = "m", .meaning = "box: full length", .rule = Rule::not_negative},
    {.name = "z", .type = KeyType::number, .unit = "m", .meaning = "box: full length", .rule = Rule::not_negative},
    {.name = "radius",
     .type = KeyType::number,
     .unit = "m",
     .meaning = "sphere, cylinder, cone, capsule",
     .rule = Rule::not_negative},
    {.name = "height",
     .type = KeyType::number,
     .unit = "m",
     .meaning = "cylinder, cone; capsule: with its caps",
     .rule = Rule::not_negative},
    {.name = "axis", .type = KeyType::text, .fallback = "z", .meaning = "cylinder, cone, capsule: x, y or z"},
    {.name = "normal", .type = KeyType::vector, .fallback = "0, 0, 1", .meaning = "plane"},
    {.name = "offset",
     .type = KeyType::number,
     .unit = "m",
     .fallback = "0",
     .meaning = "plane: distance along the normal"},
    {.name = "dx", .type = KeyType::number, .meaning = "tessellation", .status = KeyStatus::ignored},
    {.name = "dy", .type = KeyType::number, .meaning = "tessellation", .status = KeyStatus::ignored},
    {.name = "dz", .type = KeyType::number, .meaning = "tessellation", .status = KeyStatus::ignored},
    {.name = "inertial offset undef", .type = KeyType::text, .status = KeyStatus::ignored},
};

constexpr Key kPlacedShapeKeys[] = {
    {.name = "shape", .type = KeyType::choice, .required = true, .choices = kShapes, .instead = kLeftOut},
    {.name = "geometry", .type = KeyType::map, .sub = Group::geometry, .required = true},
    {.name = "offset", .type = KeyType::map, .fallback = "none", .meaning = "Pose in the body.", .sub = Group::pose},
    {.name = "name", .type = KeyType::text, .meaning = "Written by the Blender add-on.", .status = KeyStatus::ignored},
};

constexpr Key kInertiaKeys[] = {
    {.name = "ix", .type = KeyType::number, .unit = "kg m^2", .rule = Rule::not_negative, .required = true},
    {.name = "iy", .type = KeyType::number, .unit = "kg m^2", .rule = Rule::not_negative, .required = true},
    {.name = "iz", .type = KeyType::number, .unit = "kg m^2", .rule = Rule::not_negative, .required = true},
};

constexpr Key kFrictionKeys[] = {
    {.name = "static", .type = KeyType::number, .fallback = "0.5", .meaning = "Sliding.", .rule = Rule::not_negative},
    {.name = "rolling", .type = KeyType::number, .fallback = "0.01", .meaning = {}, .rule = Rule::not_negative},
};

constexpr Key kBodyDampingKeys[] = {
    {.name = "linear", .type = KeyType::number, .fallback = "0.04", .rule = Rule::not_negative},
    {.name = "angular", .type = KeyType::number, .fallback = "0.1", .rule = Rule::not_negative},
};

constexpr Key kCartesianControllerKeys[] = {
    {.name = "linear", .type = KeyType::map, .unit = "N/m", .meaning = "Gains in world axes.", .sub = Group::gains},
    {.name = "angular",
     .type = KeyType::map,
     .unit = "Nm/rad",
     .meaning = "Gains in the body's axes.",
     .sub = Group::gains},
};

constexpr Key kGainsKeys[] = {
    {.name = "P", .type = KeyType::number_or_vector, .fallback = "10", .meaning = "On the error."},
    {.name = "I", .type = KeyType::number_or_vector, .fallback = "0", .meaning = "On its integral."},
    {.name = "D", .type = KeyType::number_or_vector, .fallback = "1", .meaning = "On its derivative."},
};

constexpr Key kColorRgbaKeys[] = {
    {.name = "r", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "g", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "b", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "a", .type = KeyType::number, .fallback = "1", .meaning = "0 is invisible.", .rule = Rule::not_negative},
};

constexpr Key kRgbKeys[] = {
    {.name = "r", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "g", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "b", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
};

constexpr Key kColorComponentsKeys[] = {
    {.name = "diffuse", .type = KeyType::map, .fallback = "0.7", .sub = Group::rgb},
    {.name = "specular", .type = KeyType::map, .fallback = "1", .sub = Group::rgb},
    {.name = "emission", .type = KeyType::map, .fallback = "0", .sub = Group::rgb},
    {.name = "ambient",
     .type = KeyType::map,
     .fallback = "0.3",
     .meaning = "As part of the diffuse colour.",
     .sub = Group::ambient},
    {.name = "shininess", .type = KeyType::integer, .fallback = "64", .rule = Rule::not_negative},
    {.name = "transparency",
     .type = KeyType::number,
     .fallback = "1",
     .meaning = "1 is opaque.",
     .rule = Rule::not_negative},
    {.name = "metallic",
     .type = KeyType::number,
     .fallback = "0",
     .meaning = "1 is bare metal, which mirrors the surroundings in its diffuse colour. Ours: the original ignores it.",
     .rule = Rule::not_negative},
};

constexpr Key kAmbientKeys[] = {
    {.name = "level", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
};

constexpr Group kBodyIncludes[] = {Group::identity, Group::visual_keys, Group::collision_keys, Group::color_keys};

}  // namespace

const GroupInfo kIdentity{
    .group = Group::identity, .title = "every block", .meaning = "Keys of every block.", .keys = kIdentityKeys};
const GroupInfo kRates{.group = Group::rates, .title = "publish frequency", .meaning = {}, .keys = kRatesKeys};
const GroupInfo kVisualKeys{.group = Group::visual_keys,
                            .title = "looks",
                            .meaning = "Keys of everything that is drawn.",
                            .keys = kVisualKeysList};
const GroupInfo kCollisionKeys{.group = Group::collision_keys,
                               .title = "collision",
                               .meaning = "Keys of everything that collides.",
                               .keys = kCollisionKeysList};
const GroupInfo kColorKeys{
    .group = Group::color_keys, .title = "colour", .meaning = "Keys of everything coloured.", .keys = kColorKeysList};
const GroupInfo kBody{.group = Group::body,
                      .title = "body",
                      .meaning = "A rigid body.",
                      .keys = kBodyKeys,
                      .includes = kBodyIncludes,
                      .is_block = true};
const GroupInfo kPose{
    .group = Group::pose, .title = "pose", .meaning = "Orientation: R = Rz(y) Ry(p) Rx(r).", .keys = kPoseKeys};
const GroupInfo kGeometry{.group = Group::geometry,
                          .title = "geometry",
                          .meaning = "Sizes of a primitive; each shape needs its own. Primitives are centred.",
                          .keys = kGeometryKeys};
const GroupInfo kPlacedShape{
    .group = Group::placed_shape, .title = "compound shape", .meaning = {}, .keys = kPlacedShapeKeys};
const GroupInfo kInertia{.group = Group::inertia, .title = "inertia", .meaning = {}, .keys = kInertiaKeys};
const GroupInfo kFriction{.group = Group::friction, .title = "friction", .meaning = {}, .keys = kFrictionKeys};
const GroupInfo kBodyDamping{
    .group = Group::body_damping, .title = "damping of a body", .meaning = {}, .keys = kBodyDampingKeys};
const GroupInfo kCartesianController{.group = Group::cartesian_controller,
                                     .title = "controller of a body",
                                     .meaning = {},
                                     .keys = kCartesianControllerKeys};
const GroupInfo kGains{.group = Group::gains,
                       .title = "gains",
                       .meaning = "For bodies one number, or one for each axis.",
                       .keys = kGainsKeys};
const GroupInfo kColorRgba{.group = Group::color_rgba, .title = "color rgba", .meaning = {}, .keys = kColorRgbaKeys};
const GroupInfo kRgb{.group = Group::rgb, .title = "colour of a component", .meaning = {}, .keys = kRgbKeys};
const GroupInfo kColorComponents{
    .group = Group::color_components, .title = "color components", .meaning = {}, .keys = kColorComponentsKeys};
const GroupInfo kAmbient{.group = Group::ambient, .title = "ambient", .meaning = {}, .keys = kAmbientKeys};

}  // namespace ambf::scene::table
