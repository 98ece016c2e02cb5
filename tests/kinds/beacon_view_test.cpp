// A kind that the product does not know has a layer, a key, rows of the panel, and moves smoothly in pictures.
#include <gtest/gtest.h>

#include "beacon.h"
#include "render/marks/layer_shapes.h"
#include "render/window/keys.h"
#include "tests/render/panel_rig.h"

namespace ambf::test {
namespace {

using render::LayerId;

constexpr const char* kBeacons = R"(
beacons: [BEACON torch]
namespace: /test/
BEACON torch: {name: torch, parent: BODY lower, position: {x: 0.1, y: 0, z: 0}, blink rate: 10}
)";

struct Lighthouse : render::testing::PanelRig {
  Lighthouse() {
    state::LoadRequest request;
    request.text = kBeacons;
    EXPECT_TRUE(rig.simulation.load_and_wait(std::move(request)).success);
    pictures(2);
  }
  const state::ObjectInfo& torch() {
    const state::Structure& structure = model.structure();
    return structure.objects.at(state::find(structure, "BEACON torch", beacon_kind().kind));
  }
  render::WorldShapes draw() {
    render::WorldShapes out;
    const render::LayerInput in{rig.frame(), motion.at(now_ns), {}, render::PixelScale({}, 640, 480, 1.0)};
    render::draw_layers(layers, in, out);
    return out;
  }
};

LayerId beacons_layer() {
  const auto& all = render::all_layers();
  const auto found = std::find_if(all.begin(), all.end(), [](const auto& layer) { return layer.label == "Beacons"; });
  return static_cast<LayerId>(found - all.begin());
}

TEST(MadeUpKindInWindows, HasALayerWithAKey) {
  const render::KeyBinding* binding = render::binding_of("Y", {false, false, true}, false);
  ASSERT_NE(binding, nullptr);
  EXPECT_EQ(binding->action, render::Action::layer);
  EXPECT_EQ(binding->layer, beacons_layer());
  const std::vector<render::HelpLine> help = render::help_table();
  EXPECT_TRUE(std::any_of(help.begin(), help.end(), [](const render::HelpLine& line) {
    return line.name == "Shift+Y" && line.text == "beacons on or off";
  }));
}

TEST(MadeUpKindInWindows, IsDrawnWhereItsLayerIsShown) {
  Lighthouse scene;
  EXPECT_TRUE(scene.draw().empty());
  scene.tab("View");
  scene.click("layer/Beacons", 0.1);
  ASSERT_TRUE(scene.layers.shows(beacons_layer()));
  EXPECT_FALSE(scene.draw().empty());
}

TEST(MadeUpKindInWindows, IsInThePanelsTreeWithItsOwnRows) {
  Lighthouse scene;
  scene.click("tree/search");
  scene.type("torch");
  scene.pictures(2);
  ASSERT_TRUE(scene.shown("tree//test/torch"));
  EXPECT_FALSE(scene.shown("object/blink_rate"));
  scene.click("tree//test/torch");
  EXPECT_EQ(scene.model.selection.id(), scene.torch().id);
  EXPECT_TRUE(scene.shown("object/blink_rate"));
}

TEST(MadeUpKindInWindows, MovesSmoothlyBetweenSlowFrames) {
  Lighthouse scene;
  auto frame = state::make_frame(scene.rig.simulation.structure());
  render::Motion motion;
  for (int i = 1; i <= 2; ++i) {
    frame->sequence = static_cast<std::uint64_t>(i);
    frame->steady_ns = i * 100'000'000;
    state::rows(*frame, beacon_kind().column)[scene.torch().slot].T_world_object.position.x = i;
    motion.take(*frame);
  }
  const math::Pose* drawn = motion.at(250'000'000).of(scene.torch());
  ASSERT_NE(drawn, nullptr);
  EXPECT_NEAR(drawn->position.x, 1.5, 1e-12);
}

}  // namespace
}  // namespace ambf::test
