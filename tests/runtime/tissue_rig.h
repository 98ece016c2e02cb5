// A block of tissue on a floor with a tool above it, from the text of a file.
#pragma once

#include <string>
#include <vector>

#include "runtime/local_simulation.h"
#include "simulation_rig.h"
#include "state/soft_bodies.h"

namespace ambf::runtime::test::tissue {

inline std::string block(const std::string& tissue, const std::string& shape = "BOX",
                         const std::string& geometry = "{x: 0.04, y: 0.04, z: 0.02}") {
  return "bodies: [Floor, Tool]\nsoft bodies: [Liver]\nnamespace: /test/\n"
         "Floor: {name: Floor, mass: 0, collision shape: PLANE, collision geometry: {normal: {x: 0, y: 0, z: 1}}}\n"
         "Tool: {name: Tool, mass: 0.1, collision shape: SPHERE, collision geometry: {radius: 0.01},\n"
         "  location: {position: {x: 0.0, y: 0.0, z: 0.045}}}\n"
         "Liver:\n  name: Liver\n  shape: " +
         shape + "\n  geometry: " + geometry + "\n  collision shape: " + shape + "\n  collision geometry: " + geometry +
         "\n  collision margin: 0.001\n  location: {position: {x: 0, y: 0, z: 0.012}}\n"
         "  tissue: {young modulus: 20000, element size: 0.01, " +
         tissue + "}\n";
}

// With a cube of links, 4 mm above what ends at z = 0.022, in place of the tool, which stands aside.
inline std::string with_swab(std::string text, double mass) {
  const std::string list = "soft bodies: [", tool = "{position: {x: 0.0,";
  text.insert(text.find(']', text.find(list)), ", Swab");
  text.replace(text.find(tool), tool.size(), "{position: {x: 0.5,");
  return text +
         "Swab:\n  name: Swab\n  collision shape: BOX\n  collision geometry: {x: 0.012, y: 0.012, z: 0.012}\n"
         "  collision margin: 0.001\n  location: {position: {x: 0.001, y: 0.002, z: 0.033}}\n"
         "  config: {kDP: 0.05, piterations: 8, inner lattice: 0.004}\n  mass: " +
         std::to_string(mass) + "\n";
}

struct Scene {
  explicit Scene(const std::string& text) {
    state::LoadRequest request;
    request.text = text;
    request.path = "tissue.yaml";
    outcome = simulation.load(request);
  }
  state::ObjectId id(const std::string& name, state::ObjectKind kind) {
    const auto structure = simulation.structure();
    return structure->objects.at(state::find(*structure, name, kind)).id;
  }
  const state::SoftBodyInfo& info() { return state::soft_bodies(*simulation.structure()).at(0); }
  std::vector<math::Vec3> nodes() {
    std::vector<math::Vec3> all;
    for (const state::SoftNode& node : state::nodes_of(simulation.frame(), 0)) all.push_back(node.position_world);
    return all;
  }
  const state::SoftBodyState& state() { return state::rows(simulation.frame(), state::soft_body_kind().column).at(0); }
  bool reports(const std::string& text, base::Severity severity) {
    if (severity != base::Severity::information) log.expect_warning(text);
    for (const base::Diagnostic& found : outcome.diagnostics)
      if (found.severity == severity && found.message.find(text) != std::string::npos) return true;
    return false;
  }
  math::Vec3 tool() {
    const auto structure = simulation.structure();
    const std::uint32_t object = state::find(*structure, "Tool", state::ObjectKind::rigid_body);
    return simulation.frame().bodies.at(structure->objects.at(object).slot).T_world_body.position;
  }
  std::size_t count() { return state::soft_bodies(*simulation.structure()).size(); }

  JudgedLog log;
  LocalSimulation simulation{free_running(), empty_world(), {}, log};
  state::Outcome outcome;
};

inline std::string blade(const std::string& more) {
  return "actuators: [ACTUATOR knife]\nACTUATOR knife: {name: knife, type: Blade, parent: Tool, " + more + "}\n";
}
inline const char* const kEdge = "edge: [{x: 0, y: -0.03, z: 0}, {x: 0, y: 0.03, z: 0}]";

}  // namespace ambf::runtime::test::tissue
