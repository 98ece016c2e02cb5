// The header of a model file. The lists of its blocks are rows of the kinds of block.
#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kModelKeys[] = {
    {.name = "adf version",
     .type = KeyType::text,
     .fallback = "1.0",
     .meaning =
         "Version of the format. Only 1.0 exists; a file that names another one is refused. Upper case is accepted."},
    {.name = "namespace",
     .type = KeyType::text,
     .fallback = "none",
     .meaning = "Put before the namespace of every block, as text: end it with '/'."},
    {.name = "high resolution path",
     .type = KeyType::folder,
     .fallback = "the file's folder",
     .meaning = "Folder of the visual meshes."},
    {.name = "low resolution path",
     .type = KeyType::folder,
     .fallback = "high resolution path",
     .meaning = "Folder of the collision meshes."},
    {.name = "ignore inter-collision",
     .type = KeyType::boolean,
     .member = to<&Model::ignore_inter_collision>(),
     .meaning = "No collisions among the bodies of this file."},
    {.name = "gravity",
     .type = KeyType::vector,
     .member = to<&Model::gravity>(),
     .unit = "m/s^2",
     .fallback = "the world's",
     .meaning = "For all bodies of this file that name none."},
    {.name = "joint erp",
     .type = KeyType::number,
     .member = to<&Model::joint_erp>(),
     .fallback = "0.8",
     .meaning = "Part of a joint's error that is corrected in each step.",
     .rule = Rule::not_negative},
    {.name = "joint cfm",
     .type = KeyType::number,
     .member = to<&Model::joint_cfm>(),
     .fallback = "0",
     .meaning = "Softness of the joints.",
     .rule = Rule::not_negative},
    {.name = "shaders",
     .type = KeyType::map,
     .meaning = "Shader pair for all bodies that name none.",
     .sub = &kShaders},
    {.name = "conflict numbers",
     .type = KeyType::map,
     .fallback = "the smallest that are free",
     .meaning = "Of saved scenes (docs/saving.md): numbers behind the names of objects whose names others had before.",
     .sub = &kConflictNumber},
    {.name = "plugins",
     .type = KeyType::maps,
     .meaning = "Libraries to load with it.",
     .sub = &kPlugin,
     .status = KeyStatus::later},
    {.name = "name", .type = KeyType::text, .meaning = "A model is named by its file.", .status = KeyStatus::ignored},
};

}  // namespace

const Group kConflictNumber{
    .title = "conflict numbers",
    .meaning =
        "`{BODY Crate: 2}`: keys of blocks, and the number behind identifier and name of what is made of each; "
        "the smallest free one where it is taken. 0: none.",
    .open = true};
const Group kModel{
    .title = "model file",
    .meaning =
        "The top level of a model file: lists name the blocks that are loaded; a block that no list names is not.",
    .keys = kModelKeys,
    .is_header = true};

}  // namespace ambf::scene::group
