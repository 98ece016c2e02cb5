// A kind of block that only this test knows: registered, it is read, checked, and shown by docs and schema.
#include "scene/block_kinds.h"

#include "adf/check.h"
#include "scene/description.h"
#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

using scene::Key;
using scene::KeyType;

struct Drive {
  double gain = 2.5;
  unsigned teeth = 12;
};

struct Widget {
  std::string parent;
  math::Vec3 axis{0.0, 0.0, 1.0};
  Drive drive;
};

constexpr Key kDriveKeys[] = {
    {.name = "gain", .type = KeyType::number, .member = scene::to<&Drive::gain>(), .unit = "N/m"},
    {.name = "teeth", .type = KeyType::integer, .member = scene::to<&Drive::teeth>(), .rule = scene::Rule::positive},
};
const scene::Group kDrive{.title = "drive of a widget", .keys = kDriveKeys};

constexpr Key kWidgetKeys[] = {
    {.name = "parent", .type = KeyType::text, .member = scene::to<&Widget::parent>(), .required = true},
    {.name = "axis", .type = KeyType::vector, .member = scene::to<&Widget::axis>(), .meaning = "Where it turns."},
    {.name = "drive", .type = KeyType::map, .member = scene::to<&Widget::drive>(), .sub = &kDrive},
};
constexpr const scene::Group* kIncludes[] = {&scene::group::kIdentity};
const scene::Group kWidget{
    .title = "widget", .meaning = "Made up.", .keys = kWidgetKeys, .includes = kIncludes, .is_block = true};

std::vector<scene::BlockFinding> check_widget(const void* description) {
  if (math::norm(static_cast<const Widget*>(description)->axis) > 0.0) return {};
  return {{.key = "axis", .message = "expected a direction, found the zero vector", .hint = "usually z"}};
}

const scene::BlockKind kWidgets{
    .group = &kWidget,
    .list = {.name = "widgets", .type = KeyType::texts, .meaning = "Widget blocks to load."},
    .prefix = "WIDGET ",
    .simulated = true,
    .make = scene::make_description<Widget>,
    .check = check_widget};

class BlockKinds : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { scene::register_block_kind(kWidgets); }
};

TEST_F(BlockKinds, RegisteredBlocksAreReadFromTheirRows) {
  const ModelResult result = parse(
      "bodies: [BODY A]\nwidgets: [WIDGET W]\nnamespace: /t/\nBODY A: {name: A, mass: 1}\n"
      "WIDGET W: {name: W, parent: BODY A, drive: {gain: 7}, publish frequency: {low: 5}}\n");
  EXPECT_TRUE(result.diagnostics.empty()) << all_of(result.diagnostics);
  ASSERT_EQ(result.model->blocks.size(), 1u);
  const scene::KindBlock& block = result.model->blocks[0];
  EXPECT_EQ(block.kind, &kWidgets);
  EXPECT_EQ(block.identity.name_space + block.identity.name, "/t/W");
  EXPECT_EQ(block.identity.rate_low_hz, 5.0);
  EXPECT_EQ(block.as<Widget>().parent, "BODY A");
  EXPECT_EQ(block.as<Widget>().axis, (math::Vec3{0, 0, 1}));
  EXPECT_EQ(block.as<Widget>().drive.gain, 7.0);
  EXPECT_EQ(block.as<Widget>().drive.teeth, 12u);
}

TEST_F(BlockKinds, MistakesInThemAreReportedAndDropTheBlock) {
  const ModelResult result = parse(
      "widgets: [V, W, X]\nnamespace: /t/\nV: {name: V, parent: A, drive: {gain: much, tooth: 1}}\n"
      "W: {name: W}\nX: {name: X, parent: A, axis: {x: 0, y: 0, z: 0}}\n");
  EXPECT_TRUE(result.model->blocks.empty());
  EXPECT_TRUE(says(result.diagnostics, "model.yaml:3:39: error: \\[V: drive/gain\\] expected a number"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[V: drive/tooth\\] unknown key.*did you mean `teeth`"));
  EXPECT_TRUE(says(result.diagnostics, "error: \\[W: parent\\] missing; expected text"));
  EXPECT_TRUE(says(result.diagnostics, "model.yaml:5:31: error: \\[X: axis\\] expected a direction.*usually z"));
}

TEST_F(BlockKinds, DocsAndSchemaShowThem) {
  scene::Defaults defaults;
  Widget widget;
  widget.drive.gain = 3.5;
  defaults.set(widget);
  const std::string docs = scene::keys_as_markdown(defaults);
  for (const char* line :
       {"### widget\n", "| `widgets` | a list of names |  |  | Widget blocks to load. |",
        "| `axis` | a vector {x, y, z} |  | 0, 0, 1 | Where it turns. |", "| `gain` | a number | N/m | 3.5 |  |"}) {
    EXPECT_NE(docs.find(line), std::string::npos) << line;
  }
  const std::string schema = scene::keys_as_json_schema(defaults);
  for (const char* part : {"\"widgets\": {", "\"^WIDGET \": {\"$ref\": \"#/definitions/widget\"}", "Default: 3.5."}) {
    EXPECT_NE(schema.find(part), std::string::npos) << part;
  }
}

TEST(Defaults, ThatAreChangedAreWhatBlocksBeginWith) {
  Options options;
  options.look_for_files = false;
  scene::Body body;
  body.surface.friction = 0.625;
  options.defaults.set(body);
  const ModelResult result = parse_model(
      "bodies: [A, B]\nA: {name: A, mass: 1}\nB: {name: B, mass: 1, friction: {static: 0.25}}\n", "m.yaml", options);
  ASSERT_EQ(result.model->bodies.size(), 2u);
  EXPECT_EQ(result.model->bodies[0].surface.friction, 0.625);
  EXPECT_EQ(result.model->bodies[0].surface.rolling_friction, 0.01);
  EXPECT_EQ(result.model->bodies[1].surface.friction, 0.25);
}

}  // namespace
}  // namespace ambf::adf
