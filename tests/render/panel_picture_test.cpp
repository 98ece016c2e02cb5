// How the panel looks: its pictures are compared with committed ones, drawn off screen.
#include <gtest/gtest.h>

#include "panel_rig.h"
#include "reference_picture.h"
#include "render/gl/canvas.h"
#include "render/gl/detail/functions.h"
#include "render/gl/offscreen_context.h"
#include "render/panel/detail/panel_renderer.h"
#include "tests/support/fake_devices.h"

namespace ambf::render {
namespace {

using testing::PanelRig;

// The right part of a picture, where the panel is.
Image panel_of(const Image& picture, int left) {
  Image out;
  out.width = picture.width - left;
  out.height = picture.height;
  out.rgba.resize(4 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  for (int y = 0; y < out.height; ++y) {
    const auto* from = &picture.rgba[4 * (static_cast<std::size_t>(y) * picture.width + left)];
    std::copy(from, from + 4 * out.width, &out.rgba[4 * static_cast<std::size_t>(y) * out.width]);
  }
  return out;
}

class PanelPicture : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    context_ = OffscreenContext::open(OffscreenBackend::osmesa, why);
    ASSERT_NE(context_, nullptr) << why;
    std::string missing;
    ASSERT_TRUE(gl_.load([&](const char* name) { return context_->address_of(name); }, missing)) << missing;
  }

  Image draw(PanelRig& rig) {
    Canvas canvas(gl_);
    PanelRenderer renderer(gl_);
    std::string why;
    EXPECT_TRUE(canvas.resize(rig.width, rig.height, 1, why)) << why;
    canvas.bind();
    gl_.Viewport(0, 0, rig.width, rig.height);
    gl_.ClearColor(0.8F, 0.85F, 0.9F, 1.0F);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
    const ImDrawData* drawing = rig.ui.drawing();
    if (drawing != nullptr) {
      EXPECT_TRUE(renderer.draw(*drawing, rig.ui.fonts(), rig.ui.fonts_version(), 1, rig.ui.paper(), why)) << why;
    }
    EXPECT_EQ(gl_.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    Image image = canvas.read();
    renderer.forget(1);
    return panel_of(image, static_cast<int>(rig.ui.left_edge()));
  }

 private:
  std::unique_ptr<OffscreenContext> context_;

 protected:
  Gl gl_;
};

TEST_F(PanelPicture, ObjectsInTheDark) {
  PanelRig rig("", 640, 480, 1.0);
  rig.model.selection.select(rig.rig.id("BODY upper"));
  rig.pictures(3);
  EXPECT_TRUE(testing::matches_reference(draw(rig), "panel_objects"));
}

TEST_F(PanelPicture, JointsInTheLight) {
  PanelRig rig("", 640, 480, 1.0);
  rig.model.settings.dark = false;
  rig.model.settings.degrees = true;
  rig.tab("Joints");
  rig.model.hold_joint(rig.slot("elbow", state::ObjectKind::joint), {state::JointCommandType::position, 0.5});
  rig.run(20);
  EXPECT_TRUE(testing::matches_reference(draw(rig), "panel_joints"));
}

TEST_F(PanelPicture, DevicesOfTwoUsers) {
  FakeDevices fake;
  for (const char* name : {"left", "right"}) {
    FakeDevices::Device& device = fake.add(name);
    device.info.hardware_name = "MTM";
    device.info.effector_name = "/test/box";
    device.info.camera_names = {"/test/camera"};
    device.status.rate_hz = 1000.0;
    device.status.gains = {{500, 500, 0}, {5, 5, 0}, {10, 10, 10}, {1, 1, 1}};
    device.status.hand_gains = {{100, 100, 0}, {}, {0.1, 0.1, 0.1}, {}};
    device.status.limits.max_force_N = 4.0;
  }
  fake.devices[0].info.color = {0.4, 0.9, 0.5};
  fake.devices[0].status.wrench_u_wanted.force = {6.0, 0.0, 0.0};
  fake.devices[0].status.wrench_u_written.force = {4.0, 0.0, 0.0};
  fake.devices[0].status.at_limit = true;
  fake.devices[1].info.color = {0.5, 0.7, 1.0};
  fake.devices[1].status.fault = state::DeviceFault::silent;
  PanelRig rig("", 900, 600, 1.0, nullptr, "", &fake);
  rig.tab("Devices");
  EXPECT_TRUE(testing::matches_reference(draw(rig), "panel_devices"));
}

TEST_F(PanelPicture, AJointThatIsWhereItShouldBeHasItsMarkInTheMiddleOfTheKnob) {
  PanelRig rig("", 640, 480, 1.0);
  rig.model.settings.dark = false;
  rig.tab("Joints");
  const std::uint32_t slot = rig.slot("elbow", state::ObjectKind::joint);
  const state::JointInfo& info = rig.model.structure().joints[slot];
  ASSERT_TRUE(info.has_limits);
  rig.model.hold_joint(slot, {state::JointCommandType::position, 0.8 * info.upper});
  rig.run(3000);
  ASSERT_NEAR(rig.model.frame().joints[slot].position, 0.8 * info.upper, 0.01 * info.upper);
  const Image picture = draw(rig);
  const WidgetPlace slider = *rig.ui.place("joint/elbow");
  const int left = static_cast<int>(slider.left - rig.ui.left_edge()),
            right = static_cast<int>(slider.right - rig.ui.left_edge());
  // The middle of what is blue, or green, in a row that begins so far below the slider's upper edge.
  const auto middle = [&](int below, std::size_t colour) {
    double sum = 0.0, weight = 0.0;
    for (int x = left + 2; x < right - 2; ++x) {
      const auto at = static_cast<std::size_t>(4 * ((static_cast<int>(slider.top) + below) * picture.width + x));
      const std::uint8_t* pixel = &picture.rgba[at];
      const double excess = std::max(0, pixel[colour] - std::max(pixel[0], pixel[3 - colour]) - 30);
      sum += excess * x;
      weight += excess;
    }
    EXPECT_GT(weight, 0.0) << below;
    return sum / weight;
  };
  EXPECT_NEAR(middle(1, 1), middle(4, 2), 1.0) << "green above the blue knob";
}

TEST_F(PanelPicture, LettersAreTwiceAsLargeOnADenseScreen) {
  PanelRig usual("", 640, 480, 1.0), dense("", 1280, 960, 2.0);
  const WidgetPlace small = *usual.ui.place("run/pause"), large = *dense.ui.place("run/pause");
  EXPECT_NEAR(large.bottom - large.top, 2.0F * (small.bottom - small.top), 2.0F);
  EXPECT_NEAR(1280.0F - dense.ui.left_edge(), 2.0F * (640.0F - usual.ui.left_edge()), 2.0F);
}

TEST_F(PanelPicture, NothingIsDrawnWhileItIsClosed) {
  PanelRig rig("", 640, 480, 1.0);
  rig.ui.set_open(false);
  rig.pictures(2);
  const Image picture = draw(rig);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) ASSERT_EQ(picture.rgba[i], picture.rgba[0]);
}

}  // namespace
}  // namespace ambf::render
