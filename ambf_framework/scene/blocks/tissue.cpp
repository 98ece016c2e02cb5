// `tissue` of a soft body.
#include "scene/tissue.h"

#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kKinds[] = {word("solid", TissueKind::solid), word("thread", TissueKind::thread),
                           word("sheet", TissueKind::sheet)};

constexpr Word kTouches[] = {word("all", TissueTouches::all), word("others", TissueTouches::others),
                             word("none", TissueTouches::none)};

constexpr Key kTissueKeys[] = {
    {.name = "kind",
     .type = KeyType::choice,
     .member = to<&Tissue::kind>(),
     .meaning = "solid: all that is within the collision mesh, which is closed; thread: along `points`, or the"
                " polyline of the mesh; sheet: the triangles of the collision mesh, open or closed.",
     .words = kKinds},
    {.name = "young modulus",
     .type = KeyType::number,
     .member = to<&Tissue::young>(),
     .unit = "Pa",
     .meaning = "Stress by strain under a sudden pull: liver 5e3, fat 2e3, skin pads 1e5 to 2.5e5. Threads bend by it "
                "as solid "
                "rods do: braided silk 1e7 to 1e8, monofilaments 1e9 to 3e9.",
     .rule = Rule::positive},
    {.name = "poisson ratio",
     .type = KeyType::number,
     .member = to<&Tissue::poisson>(),
     .meaning = "How much it narrows by how much it is stretched; below 0.5, at which its volume would not change.",
     .rule = Rule::not_negative},
    {.name = "density",
     .type = KeyType::number,
     .member = to<&Tissue::density>(),
     .unit = "kg/m^3",
     .rule = Rule::positive},
    {.name = "element size",
     .type = KeyType::number,
     .member = to<&Tissue::element_size>(),
     .unit = "m",
     .fallback = "a tenth of the longest side; threads: a hundredth of the length; sheets: the triangles of the mesh",
     .meaning =
         "Largest side of the cubes, of five tetrahedra each, that it is made of; longest segment of a thread; of "
         "a sheet, longer edges are divided.",
     .rule = Rule::positive},
    {.name = "relaxation",
     .type = KeyType::map,
     .member = to<&Tissue::relaxation>(),
     .meaning = "What becomes of a stress while it is held.",
     .sub = &kTissueRelaxation},
    {.name = "friction",
     .type = KeyType::number,
     .member = to<&Tissue::friction>(),
     .meaning = "Times that of the body, or the tissue, which it touches.",
     .rule = Rule::not_negative},
    {.name = "touches",
     .type = KeyType::choice,
     .member = to<&Tissue::touches>(),
     .meaning =
         "Which tissue its surface meets, and which threads a thread does: all: others, and its own, as the lips "
         "of a cut or a knot; others; none, which is faster. It meets bodies all the same.",
     .words = kTouches},
    {.name = "max nodes",
     .type = KeyType::integer,
     .member = to<&Tissue::max_nodes>(),
     .meaning =
         "Corners of elements that there may be as cuts make them more: room that is taken at load. 0: it cannot "
         "be cut.",
     .rule = Rule::not_negative,
     .max = 80000.0},
    {.name = "points",
     .type = KeyType::maps,
     .meaning =
         "Threads: at least two places of a polyline, in the body frame; without them, the `l` lines of the OBJ file "
         "that `collision mesh`, or `mesh`, names. It is straight when nothing bends it.",
     .sub = &kThreadPoint},
    {.name = "radius",
     .type = KeyType::number,
     .member = to<&Tissue::radius>(),
     .unit = "m",
     .meaning = "Of threads: sutures 2-0 to 6-0 have 1.5e-4 to 3.5e-5.",
     .rule = Rule::positive},
    {.name = "thickness",
     .type = KeyType::number,
     .member = to<&Tissue::thickness>(),
     .unit = "m",
     .fallback = "none: sheets need one",
     .meaning = "Of sheets, about the triangles: peritoneum 1e-4 to 5e-4, skin 1e-3 to 2e-3.",
     .rule = Rule::positive},
    {.name = "regions",
     .type = KeyType::maps,
     .meaning = "Parts that differ from the rest; where they overlap, factors multiply.",
     .sub = &kTissueRegion},
};

constexpr Key kRelaxationKeys[] = {
    {.name = "share",
     .type = KeyType::number,
     .member = to<&TissueRelaxation::share>(),
     .meaning = "Of the stress that stays for good.",
     .rule = Rule::positive,
     .max = 1.0},
    {.name = "time",
     .type = KeyType::number,
     .member = to<&TissueRelaxation::time>(),
     .unit = "s",
     .meaning = "In which the rest of it falls to 1/e.",
     .rule = Rule::positive},
};

constexpr Key kRegionKeys[] = {
    {.name = "box",
     .type = KeyType::vector,
     .member = to<&TissueRegion::box>(),
     .unit = "m",
     .fallback = "none",
     .meaning = "Full lengths of its sides.",
     .rule = Rule::positive},
    {.name = "sphere",
     .type = KeyType::number,
     .member = to<&TissueRegion::sphere>(),
     .unit = "m",
     .fallback = "none",
     .meaning = "Its radius.",
     .rule = Rule::positive},
    {.name = "vertices",
     .type = KeyType::integers,
     .fallback = "none",
     .meaning = "Instead of a shape: what is around these, counted as those of `fixed nodes`."},
    {.name = "location",
     .type = KeyType::map,
     .member = to<&TissueRegion::location>(),
     .meaning = "Of the shape's middle, in the body frame.",
     .sub = &kPose},
    {.name = "fixed",
     .type = KeyType::boolean,
     .member = to<&TissueRegion::fixed>(),
     .meaning = "Only pose commands move it."},
    {.name = "density",
     .type = KeyType::number,
     .member = to<&TissueRegion::density>(),
     .meaning = "Times that of the rest.",
     .rule = Rule::positive},
    {.name = "stiffness",
     .type = KeyType::number,
     .member = to<&TissueRegion::stiffness>(),
     .meaning = "Times that of the rest.",
     .rule = Rule::positive},
    {.name = "attach to",
     .type = KeyType::text,
     .member = to<&TissueRegion::attach_to>(),
     .fallback = "none",
     .meaning = "Body that it grows on, where both are as loaded; may be in another file."},
};

constexpr Key kPointKeys[] = {
    {.name = "x", .type = KeyType::number, .unit = "m", .required = true},
    {.name = "y", .type = KeyType::number, .unit = "m", .required = true},
    {.name = "z", .type = KeyType::number, .unit = "m", .required = true},
};

}  // namespace

const Group kTissue{.title = "tissue", .meaning = "Of a soft body (tissue.md).", .keys = kTissueKeys};
const Group kTissueRelaxation{.title = "relaxation", .meaning = "Of tissue.", .keys = kRelaxationKeys};
const Group kThreadPoint{.title = "points", .meaning = "Of tissue: a place of a thread.", .keys = kPointKeys};
const Group kTissueRegion{.title = "regions", .meaning = "Of tissue, and of `config`.", .keys = kRegionKeys};

}  // namespace ambf::scene::group
