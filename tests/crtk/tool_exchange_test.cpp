// An arm's instrument is exchanged in a running world in which a second arm has the same name space.
#include <gtest/gtest.h>

#include <atomic>

#include "crtk/arm_kind.h"
#include "crtk/tool_exchange.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::crtk {
namespace {

using runtime::test::Rig;

const std::string kSpace = "/ambf/env/psm/";

adf::CrtkArm arm(const std::string& base) {
  const auto read = adf::parse_crtk_arms("crtk arms: {PSM1: {kinematics: PSM, base: '" + base +
                                             "', instruments: {'PROGRASP_FORCEPS:400093': '" AMBF_SOURCE_DIR
                                             "/ambf_models/instruments/prograsp.yaml'}}}",
                                         "arms.yaml");
  EXPECT_TRUE(read.diagnostics.empty());
  return read.arms.at(0);
}

class TwoArms : public testing::Test {
 protected:
  TwoArms() : rig(runtime::test::free_running(), "") {
    for (const double x : {0.0, 1.0}) {
      state::LoadRequest request;
      request.path = AMBF_SOURCE_DIR "/ambf_models/descriptions/multi-bodies/robots/psm.yaml";
      request.T_world_model.position = {x, 0.0, 2.0};
      EXPECT_TRUE(rig.simulation.load_and_wait(request).success);
    }
    rig.simulation.begin();
    rig.simulation.set_paused(true);
  }

  ExchangeResult exchange(const std::string& base) {
    const adf::CrtkArm described = arm(base);
    const std::atomic<bool> stopping{false};
    return exchange_tool(rig.simulation.abilities(), described, rig.id(base), described.instruments.front(), stopping);
  }

  // Bodies of the base, by identifier, that are not of its first model.
  std::vector<std::string> brought(const std::string& base) {
    const auto structure = rig.simulation.structure();
    const state::ObjectInfo& object = structure->objects[state::find(*structure, base, state::ObjectKind::rigid_body)];
    std::vector<std::string> made;
    for (const std::uint32_t child : structure->bodies[object.slot].children) {
      if (structure->objects[child].model != object.model) made.push_back(structure->objects[child].identifier);
    }
    return made;
  }

  Rig rig;
};

const std::string kFirst = kSpace + "BODY base link", kSecond = kSpace + "BODY base link1";

TEST_F(TwoArms, TheSecondGetsItsOwnInstrument) {
  for (int i = 0; i < 2; ++i) {  // of its own file, then what an exchange has brought
    const ExchangeResult result = exchange(kSecond);
    EXPECT_EQ(result.problem, "");
    EXPECT_TRUE(brought(kFirst).empty());
    EXPECT_EQ(brought(kSecond).size(), 4U);
  }
  // Beside the second arm's carriage, one metre from the first.
  rig.wait_until([&](const state::Frame&) { return !brought(kSecond).empty(); });
  const math::Vec3 carrier = rig.body(kSpace + "BODY main insertion link1").T_world_body.position;
  for (const std::string& name : brought(kSecond)) {
    EXPECT_LT(math::norm(rig.body(name).T_world_body.position - carrier), 0.6) << name;
  }
}

TEST_F(TwoArms, TheFirstGetsItsOwnInstrument) {
  const ExchangeResult result = exchange(kFirst);
  EXPECT_EQ(result.problem, "");
  EXPECT_EQ(brought(kFirst).size(), 4U);
  EXPECT_TRUE(brought(kSecond).empty());
  EXPECT_EQ(exchange(kSecond).problem, "");
  EXPECT_EQ(brought(kFirst).size(), 4U);
  EXPECT_EQ(brought(kSecond).size(), 4U);
}

}  // namespace
}  // namespace ambf::crtk
