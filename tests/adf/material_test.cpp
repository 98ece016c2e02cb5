#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

std::optional<scene::Material> material_of(const std::string& keys, const scene::ColorTable* colors = nullptr,
                                           base::Diagnostics* diagnostics = nullptr, const std::string& block = "A") {
  Options options;
  options.colors = colors;
  const ModelResult result = parse_model(
      "bodies: [" + block + "]\nnamespace: /t/\n" + block + ": {name: A, mass: 1, " + keys + "}\n", "m.yaml", options);
  if (diagnostics) *diagnostics = result.diagnostics;
  if (!result.model || result.model->bodies.empty()) {
    ADD_FAILURE() << all_of(result.diagnostics);
    return std::nullopt;
  }
  return result.model->bodies[0].visual.material;
}

TEST(Material, RgbaHasHalfItsDiffuseAsAmbient) {
  const auto material = material_of("color rgba: {r: 1, g: 0.5, b: 0, a: 0.25}");
  ASSERT_TRUE(material);
  EXPECT_EQ(material->diffuse.g, 0.5);
  EXPECT_EQ(material->ambient.g, 0.25);
  EXPECT_EQ(material->alpha, 0.25);
  EXPECT_EQ(material->shininess, 64u);
}

TEST(Material, ComponentsArriveAndAmbientIsPartOfDiffuse) {
  const auto material = material_of(
      "color components: {ambient: {level: 0.5}, diffuse: {r: 0.2, g: 0.4, b: 0.6}, specular: {r: 0.1, g: 0.1, b: 0.1},"
      "emission: {r: 0.3, g: 0, b: 0}, shininess: 10, transparency: 0.7, metallic: 0.8}");
  ASSERT_TRUE(material);
  EXPECT_EQ(material->ambient.b, 0.3);
  EXPECT_EQ(material->specular.r, 0.1);
  EXPECT_EQ(material->emission.r, 0.3);
  EXPECT_EQ(material->shininess, 10u);
  EXPECT_EQ(material->alpha, 0.7);
  EXPECT_EQ(material->metallic, 0.8);
}

TEST(Material, RgbaGoesBeforeComponentsAndNoneIsUsedWhenTurnedOff) {
  const std::string both = "color rgba: {r: 1, g: 1, b: 1}, color components: {diffuse: {r: 0, g: 0, b: 0}}";
  EXPECT_EQ(material_of(both)->diffuse.r, 1.0);
  EXPECT_FALSE(material_of(both + ", use material: false"));
  EXPECT_FALSE(material_of("visible: true"));
}

TEST(Material, NamesComeFromTheColourFile) {
  const ColorsResult colors = parse_colors("red: {r: 0xff, g: 0, b: 0, a: 0x80}\n", "colors.yaml");
  ASSERT_TRUE(colors.colors);
  const auto material = material_of("color: red", &*colors.colors);
  ASSERT_TRUE(material);
  EXPECT_EQ(material->diffuse.r, 1.0);
  EXPECT_NEAR(material->alpha, 128.0 / 255.0, 1e-12);
  base::Diagnostics diagnostics;
  EXPECT_FALSE(material_of("color: rad", &*colors.colors, &diagnostics));
  EXPECT_TRUE(says(diagnostics, "warning: \\[A: color\\] unknown colour 'rad' \\(did you mean `red`\\?\\)"));
}

TEST(Material, RandomIsTheSameAtEachStartAndDiffersBetweenBodies) {
  const auto first = material_of("color: random"), again = material_of("color: random");
  const auto other = material_of("color: random", nullptr, nullptr, "B");
  ASSERT_TRUE(first && again && other);
  EXPECT_EQ(first->diffuse.r, again->diffuse.r);
  EXPECT_EQ(first->diffuse.g, again->diffuse.g);
  EXPECT_NE(first->diffuse.r, other->diffuse.r);
}

TEST(Material, ColoursOf255AreCutOffWithAWarning) {
  base::Diagnostics diagnostics;
  EXPECT_EQ(material_of("color rgba: {r: 255, g: 0, b: 0}", nullptr, &diagnostics)->diffuse.r, 1.0);
  EXPECT_TRUE(says(diagnostics, "warning: \\[A: color rgba/r\\] expected 0 to 1, found 255"));
}

TEST(Material, OfAnItemOfACompoundGoesBeforeThatOfTheBody) {
  const auto read = [](const std::string& keys) {
    Options options;
    options.look_for_files = false;
    return parse_model("bodies: [A]\nnamespace: /t/\nA: {name: A, mass: 1, " + keys + "}\n", "m.yaml", options);
  };
  const std::string ball = "shape: SPHERE, geometry: {radius: 1}", file = "shape: MESH, geometry: {mesh: /a.stl}";
  const std::string items = "[{" + ball + ", color rgba: {r: 1, g: 0, b: 0, a: 0.5}}, {" + ball + "}, {" + file +
                            ", color components: {diffuse: {r: 0, g: 1, b: 0}, metallic: 1}}, {" + file + "}]";
  const ModelResult result = read("color rgba: {r: 0, g: 0, b: 1}, compound shape: " + items);
  ASSERT_TRUE(result.model && result.model->bodies.size() == 1) << all_of(result.diagnostics);
  const scene::Visual& visual = result.model->bodies[0].visual;
  EXPECT_EQ(visual.material->diffuse.b, 1.0);
  ASSERT_TRUE(visual.shapes[0].material);
  EXPECT_EQ(visual.shapes[0].material->diffuse.r, 1.0);
  EXPECT_EQ(visual.shapes[0].material->alpha, 0.5);
  EXPECT_FALSE(visual.shapes[1].material);
  ASSERT_TRUE(visual.meshes[0].material);
  EXPECT_EQ(visual.meshes[0].material->metallic, 1.0);
  EXPECT_FALSE(visual.meshes[1].material);
  const ModelResult own = read("use material: false, compound shape: " + items);
  EXPECT_FALSE(own.model->bodies[0].visual.shapes[0].material) << "the meshes' own, whatever stands below";

  const auto said = [&](const std::string& item) {
    return read("compound shape: [{" + ball + item + "}]").diagnostics;
  };
  EXPECT_TRUE(says(said(", color rgba: {r: 255, g: 0, b: 0}"),
                   "compound shape\\[0\\]/color rgba/r\\] expected 0 to 1, found 255"));
  EXPECT_TRUE(
      says(said(", color rgba: {r: red, g: 0, b: 0}"), "compound shape\\[0\\]/color rgba/r\\] expected a number"));
  EXPECT_TRUE(says(said(", colour: red"), "compound shape\\[0\\]/colour\\] unknown"));
  EXPECT_TRUE(says(said(", color: red"), "compound shape\\[0\\]/color\\] no colour file"));
  EXPECT_TRUE(says(read("compound collision shape: [{" + ball + ", color rgba: {r: 1, g: 0, b: 0}}]").diagnostics,
                   "compound collision shape\\[0\\]/color rgba\\] unknown"))
      << "what collides has no colour";
}

}  // namespace
}  // namespace ambf::adf
