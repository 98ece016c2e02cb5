#include "limits_page.h"

#include <vector>

#include "adf/document.h"
#include "base/bounds.h"
#include "base/limits.h"
#include "mesh/loader.h"
#include "physics/needle.h"
#include "physics/soft_body.h"
#include "physics/thread.h"
#include "physics/tissue.h"
#include "physics/world.h"
#include "scene/bounds.h"
#include "scene/keys.h"
#include "scene/soft_limits.h"
#include "state/actuators.h"

namespace ambf::simulator {

namespace {

struct Row {
  std::string what, bound, beyond, why;
};

struct Section {
  std::string title;
  std::vector<Row> rows;
};

std::string text(std::size_t number) { return std::to_string(number); }
std::string text(double number, const std::string& unit = {}) {
  return scene::text_of(number) + (unit.empty() ? "" : " " + unit);
}
std::string megabytes(std::size_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

Section numbers_of_files() {
  const std::string error = "an error at its line: the block is left out";
  Section section{"Numbers in ADF files", {}};
  for (const scene::Bound& bound : scene::bounds()) {
    const std::string unit(bound.unit);
    const std::string from = bound.min > 0.0 ? text(bound.min) + " to " : "";
    section.rows.push_back({std::string(bound.what) + (bound.key.empty() ? "" : " (`" + std::string(bound.key) + "`)"),
                            from + text(bound.max, unit), error,
                            bound.unit == "m" ? "a double resolves 0.1 nm there, and collision detection needs that"
                                              : "far beyond any robot; squares and ratios stay numbers"});
  }
  section.rows.push_back({"a moment of inertia, above the sum of the other two",
                          "by a factor of " + text(base::kMaxInertiaExcess),
                          "the nearest inertia that a body can have, with a warning; a smaller excess is hinted at",
                          "no body has one; such bodies fall through floors"});
  section.rows.push_back({"the mesh of a moving body", text(base::kPlausibleMeshSize_m, "m"),
                          "used as it is; a hint names the size", "most likely it is written in millimetres"});
  section.rows.push_back(
      {"a collision shape", text(base::kMaxLength_m, "m"), "an error: the body is there without it", "as positions"});
  return section;
}

Section files() {
  const mesh::LoadOptions mesh;
  namespace adf_limits = adf::limits;
  const std::string refused = "the file is refused, with the number";
  return {"Files",
          {{"an ADF file", megabytes(adf_limits::kFileBytes), refused, "read whole: 1 GiB of memory, 5 s"},
           {"values in it", text(adf_limits::kNodes), refused, "as above"},
           {"values, with every alias written out", text(static_cast<std::size_t>(adf_limits::kExpandedNodes)), refused,
            "aliases of aliases grow without end"},
           {"depth of maps and lists", text(static_cast<std::size_t>(adf_limits::kDepth)), refused,
            "each level takes stack"},
           {"names in one list of a header", text(adf_limits::kListedBlocks), refused, "time to load"},
           {"findings shown of one file", text(adf_limits::kDiagnostics), "counted", "nobody reads more"},
           {"a mesh file", megabytes(mesh.max_file_bytes), "the mesh is left out, with an error", "memory and 5 s"},
           {"triangles of a mesh", text(mesh.max_triangles), "the mesh is left out, with an error", "memory and 5 s"},
           {"vertices of a mesh", text(mesh.max_vertices), "the mesh is left out, with an error", "memory and 5 s"},
           {"points of a POINT_CLOUD", text(base::kMaxCloudPoints),
            "an error: the body is there without a collision shape", "each is tested against what it touches"}}};
}

Section requests() {
  return {
      "Messages and requests",
      {{"lengths in a message", "the bytes that came", "refused, counted, logged with the sender",
        "roscpp allocates what a message claims"},
       {"memory of a message beyond its size", megabytes(base::kMaxMessageExpansion), "as above",
        "many short texts take several times what came"},
       {"a commanded position", text(base::kMaxLength_m, "m"), "the command is refused and counted", "as in files"},
       {"a commanded force, torque or joint value", text(base::kMaxForce), "the command is refused and counted",
        "a mistake, not a wish"},
       {"a commanded velocity", text(base::kMaxSpeed, "m/s or rad/s"), "the command is refused and counted",
        "a mistake, not a wish"},
       {"entries of `joint_cmds`", text(base::kMaxJointCommands), "the command is refused and counted",
        "no robot has as many joints"},
       {"names and paths", text(base::kMaxPath) + " bytes", "the request is refused", "PATH_MAX of Linux"},
       {"states that a Step wants", "the number of objects, or " + text(base::kMinWantedStates), "refused",
        "each is looked for by its name"},
       {"states in one answer", megabytes(base::kMaxStepAnswer), "the steps are run, no state is sent",
        "it is copied three times"},
       {"levels of an XML-RPC request", text(static_cast<std::size_t>(base::kMaxXmlDepth)), "the call is refused",
        "roscpp's parser overflows its stack"},
       {"requests in flight", text(base::kMaxRequests) + ", of them " + text(base::kMaxStepRequests) + " steps",
        "refused, with a warning", "pausing and resetting stay possible"},
       {"World/Command messages in one iteration", text(base::kMaxWorldCommands), "lost, with a warning, and counted",
        "each toggle of the step clock counts"},
       {"recorders that request every step", text(base::kMaxStepRecorders), "refused", "each is a list of topics"},
       {"steps that wait to be published to recorders", text(base::kMaxUnpublishedSteps),
        "in real time further ones are left out and counted as lost; else the simulation waits, for at most 5 s of a "
        "recorder's silence",
        "a quarter of a second of frames"},
       {"kept snapshots", text(base::kMaxSnapshots) + ", " + megabytes(base::kMaxSnapshotBytes) + " together",
        "refused; `World/Forget` lets one go", "memory"},
       {"name of a snapshot", text(base::kMaxSnapshotName) + " bytes", "refused", "it is shown in lists"},
       {"a state file", megabytes(base::kMaxSnapshotBytes), "refused after its first bytes", "memory"}}};
}

Section world() {
  return {
      "The world",
      {{"objects", text(base::kMaxObjects), "further blocks are left out, with an error",
        "their dirty flags are allocated at the start"},
       {"readers of frames", text(static_cast<std::size_t>(base::kMaxReaders)),
        "no reader is given: a program waits for its next try, a Step request is refused and says why",
        "each costs two frames, 0.27 MB with three arms"},
       {"sources of commands and laws", text(static_cast<std::size_t>(base::kMaxSources)),
        "such a port cannot be bound", "one 64-bit mask of each object"},
       {"pointers that hold bodies", text(base::kMaxPicks),
        "no further port; the mouse of one more window does not hold anything", "windows and devices"},
       {"bodies held by input devices", text(base::kMaxEffectors), "no further port; that device moves nothing",
        "one for each device on a body"},
       {"bodies that one actuator holds", text(base::kMaxHeldBodies), "further bodies that its sensor senses are left",
        "joints for all of them are made with it: a grasp allocates nothing"},
       {"nodes of soft bodies that one actuator holds", text(state::kMaxHeldNodes),
        "further nodes of the faces that its sensor senses are left", "a grasp allocates nothing"},
       {"nodes of a soft body with `config`, and of the surface of tissue", text(scene::kMaxSoftNodes),
        "an error: the soft body is left out", "a coarse `collision mesh` carries a fine `mesh`"},
       {"elements of tissue, triangles of a sheet", text(scene::kMaxTissueElements),
        "an error with the number and the time of a step", "10 ms a step"},
       {"nodes of a thread", text(scene::kMaxThreadNodes), "an error with the number: the soft body is left out",
        "2 ms a step while all of it moves"},
       {"places in which threads that touch each other bear on each other at once",
        text(physics::Thread::kMaxCrossings), "further ones do not push, which is logged once",
        "3 ms a step; they are solved together"},
       {"punctures of one needle at once", text(physics::Needle::kMaxPunctures),
        "those within tissue become sparser, and the tip goes through no further face", "a stitch allocates nothing"},
       {"needles in one soft body", text(physics::Needle::kMaxInOneBody),
        "further ones pass through it until one leaves", "as above"},
       {"stitches of one needle's thread, those within tissue included", text(physics::Needle::kMaxStitches),
        "what more its rear passes is left, which is logged once", "a stitch allocates nothing"},
       {"knots of one needle's thread", text(physics::Needle::kMaxKnots),
        "it ties no further one, which is logged once", "as above"},
       {"places where a thread with stitches is held", text(physics::Needle::kMaxHolders),
        "sewn tissue does not feel the others, which is logged once", "as above"},
       {"places in which tissue touches tissue in a step",
        "two a node and " + text(physics::Tissue::kFurtherTouches) + " more",
        "further ones do not push, which is logged once", "a step allocates nothing"},
       {"tips and edges of bodies that touch faces of one tissue at once", text(physics::Tissue::kMaxTips), "as above",
        "as above"},
       {"points of tissue that touch triangles of one soft body with `config` at once",
        text(physics::SoftBody::kMaxTissuePoints), "as above", "as above"},
       {"laws held by `LiveWorld::hold`", "one a body and " + text(base::kSpareLaws) + " more", "refused",
        "nothing is allocated while the simulation runs"},
       {"shares of laws in a frame", "one an object and " + text(base::kSpareLaws) + " more",
        "laws act all the same; `law_shares_total` says how many there are", "as above"},
       {"contacts in a frame", text(base::kMaxContactsInFrame),
        "they act all the same; `contacts_total` says how many there are", "a pile of 300 cubes fits"},
       {"contacts of one contact sensor", text(base::kMaxContactsOfASensor),
        "further ones are left out of its readings", "more than any finger has"},
       {"contacts of all contact sensors", text(base::kMaxSensedContacts),
        "further ones are left out of their readings", "0.5 MB a frame"},
       {"overlaps that ghost objects feel", text(base::kMaxGhostTouches), "further ones are left out of their readings",
        "64 kB a frame"},
       {"events of sensors between two frames", text(base::kMaxSensorEvents),
        "the oldest are lost, counted and logged with their number",
        "two seconds of a sensor that flickers in each step"},
       {"joints with entries in one command", "as the body has below it", "entries beyond are ignored and counted",
        "nothing is allocated while the simulation runs"}}};
}

Section physics() {
  return {
      "Physics",
      {{"what a command makes of a body", text(base::kMaxCommandedSpeed, "m/s or rad/s"),
        "forces, torques, efforts, velocities and pose errors are cut to what reaches it; one warning a source and "
        "body, then counted",
        "no command may stop the others ([decision](decisions/0023-frozen-bodies.md))"},
       {"speed of a body",
        text(physics::SpeedLimits().linear, "m/s") + ", " + text(physics::SpeedLimits().angular, "rad/s") + ", finite",
        "it is frozen where it was with all that joints connect to it, until a reset or a command within bounds, "
        "with a warning; the world pauses only when nothing else moves",
        "nothing sensible moves so fast"},
       {"moving bodies near one body, in a crowd", text(static_cast<std::size_t>(base::kMaxNearBodies)),
        "it meets " + text(static_cast<std::size_t>(base::kNewNearBodies)) +
            " new ones at a time, and static bodies always; one warning names the crowd, which comes apart",
        "memory and time would grow with the square of their number"},
       {"work for the joints of a mechanism in one step",
        text(static_cast<std::size_t>(base::kMaxJointWork)) + " visits of a row",
        "which motors and limits bind is found roughly; over 10,000 rows, contacts of the mechanism get fewer sweeps",
        "a chain of 1000 links in the floor took 13 s a step"},
       {"way of a body in one step", "the radius of the largest ball in one of its convex parts",
        "it is swept, and stops where it meets something; not: jointed bodies, moving meshes, compounds of more than "
        "16 parts, and what only turns",
        "a sweep costs microseconds"},
       {"mass of a load to that of the links of its rope", "tested to 1e4", "it holds; 1e6 held in trials",
        "the geometric stiffness of joints is implicit (decision 0024)"},
       {"mass of a body to that of the one it rests on", "tested to 1e4", "heavier ones sink in slowly",
        "more sweeps for such islands (decision 0024)"}}};
}

std::vector<Section> sections() { return {numbers_of_files(), files(), requests(), world(), physics()}; }

}  // namespace

std::string limits_as_text() {
  std::string out;
  for (const Section& section : sections()) {
    out += section.title + "\n";
    for (const Row& row : section.rows) out += "  " + row.what + ": " + row.bound + "; beyond: " + row.beyond + "\n";
  }
  return out;
}

std::string limits_as_markdown() {
  std::string out =
      "# Limits\n\n"
      "Generated from the code (`ambf_simulator/limits_page.cpp`); `ambf_simulator --limits` prints the same. What "
      "lies\n"
      "beyond a bound is never silent, and never ends the program. How it is built: "
      "[architecture.md](architecture.md).\n";
  for (const Section& section : sections()) {
    out += "\n## " + section.title + "\n\n| what | bound | beyond | why |\n|---|---|---|---|\n";
    for (const Row& row : section.rows)
      out += "| " + row.what + " | " + row.bound + " | " + row.beyond + " | " + row.why + " |\n";
  }
  return out;
}

}  // namespace ambf::simulator
