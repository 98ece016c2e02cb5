// From ADF files to pixels: shaders and skyboxes as users write them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "adf/adf.h"
#include "offscreen_fixture.h"
#include "still_picture.h"

namespace ambf::render {
namespace {

using testing::pixel;
using testing::Rgb;

class Looks : public ::testing::Test {
 protected:
  Looks() { std::filesystem::create_directories(folder_ / "shaders"); }
  ~Looks() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  void write_face(const std::string& name, std::uint8_t r, std::uint8_t g, std::uint8_t b) const {
    Image image{8, 8, {}};
    for (int i = 0; i < 64; ++i) image.rgba.insert(image.rgba.end(), {r, g, b, 255});
    std::string why;
    EXPECT_TRUE(write_png((folder_ / name).string(), image, why)) << why;
  }
  // What the world's camera sees once `models` are loaded.
  Image picture(const std::vector<std::string>& models) {
    const adf::WorldResult world = adf::load_world((folder_ / "world.yaml").string(), {});
    EXPECT_TRUE(world.world);
    if (!world.world) return {};
    for (const base::Diagnostic& finding : world.diagnostics) {
      EXPECT_EQ(finding.message.find("no effect"), std::string::npos) << finding.key;
    }
    testing::StillSimulation simulation(*world.world);
    for (const std::string& model : models) simulation.load((folder_ / model).string());
    return simulation.picture(320, 240);
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ambf looks " + std::to_string(getpid()));
};

// From (3, 0, 0) along -x: y to the right, z up; a metre at the origin is 110 px.
constexpr const char* kCamera =
    "camera: {name: camera, location: {x: 3, y: 0, z: 0}, look at: {x: 0, y: 0, z: 0}, up: {x: 0, y: 0, z: 1}}\n";

std::string box(const std::string& name, double y, const std::string& more) {
  return "BODY " + name + ":\n  name: " + name +
         "\n  shape: Box\n  geometry: {x: 0.3, y: 0.3, z: 0.3}\n  mass: 0\n  location: {position: {x: 0, y: " +
         std::to_string(y) + ", z: 0}, orientation: {r: 0, p: 0, y: 0}}\n" + more;
}

TEST_F(Looks, ABodysShadersComeBeforeItsModelsAndThoseBeforeTheWorlds) {
  write("shaders/s.vs", "void main() { gl_Position = ftransform(); }\n");
  write("shaders/red.fs", "void main() { gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0); }\n");
  write("shaders/green.fs", "void main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }\n");
  write("shaders/blue.fs", "void main() { gl_FragColor = vec4(0.0, 0.0, 1.0, 1.0); }\n");
  const auto shaders = [](const std::string& name) {
    return "shaders: {path: ./shaders/, vertex: s.vs, fragment: " + name + "}\n";
  };
  write("world.yaml", "environment: empty.yaml\ncameras: [camera]\n" + shaders("blue.fs") + kCamera);
  write("empty.yaml", "bodies: []\n");
  write("with.yaml", "bodies: [BODY own, BODY plain]\n" + shaders("green.fs") +
                         box("own", -0.6, "  " + shaders("red.fs")) + box("plain", 0.0, ""));
  write("without.yaml", "bodies: [BODY other]\n" + box("other", 0.6, ""));
  const Image image = picture({"with.yaml", "without.yaml"});
  ASSERT_EQ(image.width, 320);
  const Rgb body = pixel(image, 160 - 68, 120), model = pixel(image, 160, 120), world = pixel(image, 160 + 68, 120);
  EXPECT_EQ(body.r, 255);
  EXPECT_EQ(body.g, 0);
  EXPECT_EQ(model.g, 255);
  EXPECT_EQ(model.r, 0);
  EXPECT_EQ(world.b, 255);
  EXPECT_EQ(world.g, 0);
}

TEST_F(Looks, SixPicturesAreTheSky) {
  write("world.yaml", std::string("environment: empty.yaml\ncameras: [camera]\nskybox: {path: ./sky/, right: r.png, "
                                  "left: l.png, top: t.png, bottom: b.png, front: f.png, "
                                  "back: k.png}\n") +
                          kCamera);
  write("empty.yaml", "bodies: []\n");
  std::filesystem::create_directories(folder_ / "sky");
  write_face("sky/f.png", 210, 30, 40);
  for (const char* name : {"sky/r.png", "sky/l.png", "sky/t.png", "sky/b.png", "sky/k.png"})
    write_face(name, 20, 60, 200);
  const Image image = picture({});
  ASSERT_EQ(image.width, 320);
  EXPECT_NEAR(pixel(image, 160, 120).r, 210, 3);
  EXPECT_NEAR(pixel(image, 160, 120).b, 40, 3);
}

}  // namespace
}  // namespace ambf::render
