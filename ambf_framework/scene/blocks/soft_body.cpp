// A soft body: checked, not simulated yet.
#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kSoftBodyKeys[] = {
    {.name = "mass", .type = KeyType::number, .unit = "kg", .fallback = "1", .rule = Rule::not_negative},
    {.name = "location", .type = KeyType::map, .sub = &kPose},
    {.name = "inertial offset", .type = KeyType::map, .sub = &kPose},
    {.name = "config", .type = KeyType::map, .meaning = "Bullet's soft body settings.", .sub = &kSoftConfig},
    {.name = "randomize constraints", .type = KeyType::boolean, .fallback = "false"},
    {.name = "linear gain", .type = KeyType::number_or_map, .sub = &kGains, .status = KeyStatus::ignored},
    {.name = "angular gain", .type = KeyType::number_or_map, .sub = &kGains, .status = KeyStatus::ignored},
};

constexpr Key kSoftConfigKeys[] = {
    {.name = "kLST", .type = KeyType::number, .fallback = "1", .meaning = "linear stiffness"},
    {.name = "kAST", .type = KeyType::number, .fallback = "1", .meaning = "angular stiffness"},
    {.name = "kVST", .type = KeyType::number, .fallback = "1", .meaning = "volume stiffness"},
    {.name = "kVCF", .type = KeyType::number, .fallback = "1", .meaning = "velocity correction"},
    {.name = "kDP", .type = KeyType::number, .fallback = "0", .meaning = "damping"},
    {.name = "kDG", .type = KeyType::number, .fallback = "0", .meaning = "drag"},
    {.name = "kLF", .type = KeyType::number, .fallback = "0", .meaning = "lift"},
    {.name = "kPR", .type = KeyType::number, .fallback = "0", .meaning = "pressure"},
    {.name = "kVC", .type = KeyType::number, .fallback = "0", .meaning = "volume conservation"},
    {.name = "kDF", .type = KeyType::number, .fallback = "0.2", .meaning = "dynamic friction"},
    {.name = "kMT", .type = KeyType::number, .fallback = "0", .meaning = "pose matching"},
    {.name = "kCHR", .type = KeyType::number, .fallback = "1", .meaning = "rigid contact hardness"},
    {.name = "kKHR", .type = KeyType::number, .fallback = "0.1", .meaning = "kinetic contact hardness"},
    {.name = "kSHR", .type = KeyType::number, .fallback = "1", .meaning = "soft contact hardness"},
    {.name = "kAHR", .type = KeyType::number, .fallback = "0.7", .meaning = "anchor hardness"},
    {.name = "kSRHR_CL", .type = KeyType::number, .fallback = "0.1", .meaning = "cluster against rigid"},
    {.name = "kSKHR_CL", .type = KeyType::number, .fallback = "1", .meaning = "cluster against kinetic"},
    {.name = "kSSHR_CL", .type = KeyType::number, .fallback = "0.5", .meaning = "cluster against soft"},
    {.name = "kSR_SPLT_CL", .type = KeyType::number, .fallback = "0.5"},
    {.name = "kSK_SPLT_CL", .type = KeyType::number, .fallback = "0.5"},
    {.name = "kSS_SPLT_CL", .type = KeyType::number, .fallback = "0.5"},
    {.name = "maxvolume", .type = KeyType::number, .fallback = "1"},
    {.name = "timescale", .type = KeyType::number, .fallback = "1"},
    {.name = "viterations", .type = KeyType::integer, .fallback = "0"},
    {.name = "piterations", .type = KeyType::integer, .fallback = "1"},
    {.name = "diterations", .type = KeyType::integer, .fallback = "0"},
    {.name = "citerations", .type = KeyType::integer, .fallback = "4"},
    {.name = "flags", .type = KeyType::integer, .fallback = "1", .meaning = "collision flags of Bullet, as bits"},
    {.name = "bending constraint", .type = KeyType::integer, .fallback = "off", .meaning = "distance in links"},
    {.name = "clusters", .type = KeyType::integer, .fallback = "off"},
    {.name = "fixed nodes",
     .type = KeyType::integers,
     .fallback = "none",
     .meaning = "vertices as the mesh file counts them"},
    {.name = "cutting", .type = KeyType::text, .status = KeyStatus::ignored},
    {.name = "margin", .type = KeyType::number, .status = KeyStatus::ignored},
};

constexpr const Group* kLooks[] = {&kIdentity, &kVisual, &kCollision, &kColor};

}  // namespace

const Group kSoftBody{
    .title = "soft body", .meaning = "Not simulated yet.", .keys = kSoftBodyKeys, .includes = kLooks, .is_block = true};
const Group kSoftConfig{.title = "config", .keys = kSoftConfigKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kSoftBody{.group = &group::kSoftBody,
                          .list = {.name = "soft bodies", .type = KeyType::texts, .meaning = "Soft body blocks."},
                          .prefix = "BODY "};

}  // namespace ambf::scene::kind
