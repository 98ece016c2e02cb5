// What is drawn and what collides: meshes, primitives and colours.
#include <algorithm>
#include <array>

#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kShapeWords[] = {
    word("Box", Shape::box),           word("box", Shape::box),           word("BOX", Shape::box),
    word("Sphere", Shape::sphere),     word("sphere", Shape::sphere),     word("SPHERE", Shape::sphere),
    word("Cylinder", Shape::cylinder), word("cylinder", Shape::cylinder), word("CYLINDER", Shape::cylinder),
    word("Capsule", Shape::capsule),   word("capsule", Shape::capsule),   word("CAPSULE", Shape::capsule),
    word("Cone", Shape::cone),         word("cone", Shape::cone),         word("CONE", Shape::cone),
    word("Plane", Shape::plane),       word("plane", Shape::plane),       word("PLANE", Shape::plane),
};

// Items of compounds may be meshes, too, which are no primitives.
constexpr int kNoPrimitive = -1;
constexpr auto kItemWords = [] {
  std::array<Word, std::size(kShapeWords) + 3> words{};
  std::copy(std::begin(kShapeWords), std::end(kShapeWords), words.begin());
  const Word mesh[] = {{"Mesh", kNoPrimitive}, {"mesh", kNoPrimitive}, {"MESH", kNoPrimitive}};
  std::copy(std::begin(mesh), std::end(mesh), words.begin() + std::size(kShapeWords));
  return words;
}();

constexpr Word kMeshTypes[] = {
    word("CONVEX_HULL", CollisionMeshType::convex_hull), word("convex_hull", CollisionMeshType::convex_hull),
    word("hull", CollisionMeshType::convex_hull),        word("CONVEX_MESH", CollisionMeshType::convex_mesh),
    word("convex_mesh", CollisionMeshType::convex_mesh), word("CONCAVE_MESH", CollisionMeshType::triangle_mesh),
    word("TRIMESH", CollisionMeshType::triangle_mesh),   word("trimesh", CollisionMeshType::triangle_mesh),
    word("POINT_CLOUD", CollisionMeshType::point_cloud), word("point_cloud", CollisionMeshType::point_cloud),
};

constexpr Key kVisualKeysList[] = {
    {.name = "mesh",
     .type = KeyType::file,
     .fallback = "none",
     .meaning = "Visual mesh, in the high resolution path. '' means none."},
    {.name = "mesh remove duplicates",
     .type = KeyType::boolean,
     .member = to<&Visual::remove_duplicates>(),
     .meaning = "Equal vertices of meshes are always welded; the key changes nothing."},
    {.name = "shape",
     .type = KeyType::choice,
     .fallback = "none",
     .meaning = "Visual primitive; needs `geometry`. Goes before `compound shape`, and that before `mesh`.",
     .words = kShapeWords,
     .instead = "none"},
    {.name = "geometry", .type = KeyType::map, .meaning = "Sizes of `shape`.", .sub = &kGeometry},
    {.name = "compound shape",
     .type = KeyType::maps,
     .meaning = "Several visual primitives and meshes.",
     .sub = &kDrawnItem},
    {.name = "high resolution path",
     .type = KeyType::folder,
     .fallback = "the file's",
     .meaning = "Folder of the visual mesh, instead of the file's. Where the mesh is not there, file's path + this "
                "path is tried."},
    {.name = "low resolution path",
     .type = KeyType::folder,
     .fallback = "the block's high resolution path, else the file's",
     .meaning = "Folder of the collision mesh, likewise."},
    {.name = "visible", .type = KeyType::boolean, .member = to<&Visual::visible>(), .meaning = "Whether it is drawn."},
    {.name = "scale",
     .type = KeyType::number,
     .member = to<&Visual::scale>(),
     .meaning = "Multiplies visual and collision meshes and shapes, and the joint pivots on this body.",
     .rule = Rule::positive},
    {.name = "shaders",
     .type = KeyType::map,
     .fallback = "the file's, else the world's",
     .meaning = "Shader pair.",
     .sub = &kShaders},
};

constexpr Key kCollisionKeysList[] = {
    {.name = "collision margin",
     .type = KeyType::number,
     .member = to<&Collision::margin>(),
     .unit = "m",
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
     .words = kShapeWords,
     .instead = "none"},
    {.name = "collision geometry", .type = KeyType::map, .meaning = "Sizes of `collision shape`.", .sub = &kGeometry},
    {.name = "collision offset",
     .type = KeyType::map,
     .member = to<&Collision::offset>(),
     .fallback = "inertial offset",
     .meaning = "Pose of `collision shape` or of the collision mesh in the body.",
     .sub = &kPose},
    {.name = "compound collision shape",
     .type = KeyType::maps,
     .meaning = "Several collision primitives, and meshes, which collide as their convex hulls; placed in the body.",
     .sub = &kPlacedShape},
    {.name = "collision mesh", .type = KeyType::file, .fallback = "mesh", .meaning = "In the low resolution path."},
    {.name = "collision mesh type",
     .type = KeyType::choice,
     .member = to<&Collision::mesh_type>(),
     .meaning = "What is made of the collision mesh: its hull; a convex shape of its vertices; its triangles; a sphere "
                "of radius `collision margin` at each vertex.",
     .words = kMeshTypes,
     .instead = "CONCAVE_MESH"},
};

constexpr Key kColorKeysList[] = {
    {.name = "use material",
     .type = KeyType::boolean,
     .fallback = "true",
     .meaning = "false: the mesh's own colours, whatever stands below."},
    {.name = "color rgba",
     .type = KeyType::map,
     .meaning = "One colour, 0 to 1. Goes before `color components`.",
     .sub = &kColorRgba},
    {.name = "color components",
     .type = KeyType::map,
     .meaning = "All parts of the material.",
     .sub = &kColorComponents},
    {.name = "color",
     .type = KeyType::text_or_map,
     .fallback = "the mesh's own",
     .meaning =
         "A name of the colour file, or random (the same at each start). Used when neither of the above is given.",
     .sub = &kColorRgba},
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
    {.name = "mesh",
     .type = KeyType::file,
     .meaning = "MESH, an item of a compound: in the high resolution path, for collision in the low one"},
    {.name = "scale",
     .type = KeyType::number_or_vector,
     .fallback = "1",
     .meaning = "MESH: of all axes or of each, besides that of the body; below 0 mirrors"},
    {.name = "dx", .type = KeyType::number, .meaning = "tessellation", .status = KeyStatus::ignored},
    {.name = "dy", .type = KeyType::number, .meaning = "tessellation", .status = KeyStatus::ignored},
    {.name = "dz", .type = KeyType::number, .meaning = "tessellation", .status = KeyStatus::ignored},
    {.name = "inertial offset undef", .type = KeyType::text, .status = KeyStatus::ignored},
};

// Of what collides the first few.
constexpr Key kItemKeys[] = {
    {.name = "shape", .type = KeyType::choice, .required = true, .words = kItemWords, .instead = "none"},
    {.name = "geometry", .type = KeyType::map, .sub = &kGeometry, .required = true},
    {.name = "offset", .type = KeyType::map, .fallback = "none", .meaning = "Pose in the body.", .sub = &kPose},
    {.name = "name", .type = KeyType::text, .meaning = "Written by the Blender add-on.", .status = KeyStatus::ignored},
    {.name = "color rgba",
     .type = KeyType::map,
     .fallback = "the body's",
     .meaning = "Colour of this item alone. Goes before the item's other colours, and they before those of the body. "
                "Ours, as the next two: the original has one colour a body.",
     .sub = &kColorRgba},
    {.name = "color components",
     .type = KeyType::map,
     .fallback = "the body's",
     .meaning = "All parts of the item's material.",
     .sub = &kColorComponents},
    {.name = "color",
     .type = KeyType::text_or_map,
     .fallback = "the body's",
     .meaning = "A name of the colour file, or random.",
     .sub = &kColorRgba},
};
constexpr std::size_t kColorlessItemKeys = 4;

constexpr Key kColorRgbaKeys[] = {
    {.name = "r", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "g", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "b", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
    {.name = "a", .type = KeyType::number, .fallback = "1", .meaning = "0 is invisible.", .rule = Rule::not_negative},
};

constexpr Key kColorComponentsKeys[] = {
    {.name = "diffuse", .type = KeyType::map, .member = to<&Material::diffuse>(), .fallback = "0.7", .sub = &kRgb},
    {.name = "specular", .type = KeyType::map, .member = to<&Material::specular>(), .fallback = "1", .sub = &kRgb},
    {.name = "emission", .type = KeyType::map, .member = to<&Material::emission>(), .fallback = "0", .sub = &kRgb},
    {.name = "ambient",
     .type = KeyType::map,
     .fallback = "0.3",
     .meaning = "As part of the diffuse colour.",
     .sub = &kAmbient},
    {.name = "shininess", .type = KeyType::integer, .member = to<&Material::shininess>(), .rule = Rule::not_negative},
    {.name = "transparency",
     .type = KeyType::number,
     .member = to<&Material::alpha>(),
     .meaning = "1 is opaque.",
     .rule = Rule::not_negative},
    {.name = "metallic",
     .type = KeyType::number,
     .member = to<&Material::metallic>(),
     .meaning = "1 is bare metal, which mirrors the surroundings in its diffuse colour. Ours: the original ignores it.",
     .rule = Rule::not_negative},
};

constexpr Key kRgbKeys[] = {
    {.name = "r", .type = KeyType::number, .member = to<&Color::r>(), .rule = Rule::not_negative, .required = true},
    {.name = "g", .type = KeyType::number, .member = to<&Color::g>(), .rule = Rule::not_negative, .required = true},
    {.name = "b", .type = KeyType::number, .member = to<&Color::b>(), .rule = Rule::not_negative, .required = true},
};

constexpr Key kAmbientKeys[] = {
    {.name = "level", .type = KeyType::number, .rule = Rule::not_negative, .required = true},
};

}  // namespace

const Group kVisual{.title = "looks", .meaning = "Keys of everything that is drawn.", .keys = kVisualKeysList};
const Group kCollision{
    .title = "collision", .meaning = "Keys of everything that collides.", .keys = kCollisionKeysList};
const Group kColor{.title = "colour", .meaning = "Keys of everything coloured.", .keys = kColorKeysList};
const Group kGeometry{.title = "geometry",
                      .meaning = "Sizes of a primitive; each shape needs its own. Primitives are centred.",
                      .keys = kGeometryKeys};
const Group kDrawnItem{.title = "compound shape", .keys = kItemKeys};
const Group kPlacedShape{.title = "compound collision shape", .keys = std::span(kItemKeys).first(kColorlessItemKeys)};
const Group kColorRgba{.title = "color rgba", .keys = kColorRgbaKeys};
const Group kColorComponents{.title = "color components", .keys = kColorComponentsKeys};
const Group kRgb{.title = "colour of a component", .keys = kRgbKeys};
const Group kAmbient{.title = "ambient", .keys = kAmbientKeys};

}  // namespace ambf::scene::group
