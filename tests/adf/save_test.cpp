// A user's file is edited where something has changed; every other byte stays.
#include "adf/save.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "adf/detail/text_edit.h"
#include "math/rotation.h"
#include "tests/adf/support.h"
#include "tests/support/compat_models.h"

namespace ambf::adf {
namespace {

namespace fs = std::filesystem;

std::string edited(const std::string& text, const Change& change) {
  const Document document(text);
  const EditedText result = edit(text, document, change);
  return result.text ? *result.text : "refused: " + result.error->message;
}

Change scalar(const std::string& text) {
  Change change;
  change.scalar = text;
  return change;
}

Change at(std::initializer_list<std::string> keys, Change inner) {
  for (auto key = std::rbegin(keys); key != std::rend(keys); ++key) {
    Change outer;
    outer.key(*key) = std::move(inner);
    inner = std::move(outer);
  }
  return inner;
}

TEST(Edit, OneNumberIsReplacedAndAllElseStays) {
  EXPECT_EQ(edited("# top\na: {x: 1.50, y: '2'}  # why\nb: [1,2]\n\n", at({"a", "x"}, scalar("3"))),
            "# top\na: {x: 3, y: '2'}  # why\nb: [1,2]\n\n");
  EXPECT_EQ(edited("a:\n    x:   1 # one\n    y: \"2\"", at({"a", "y"}, scalar("7"))),
            "a:\n    x:   1 # one\n    y: \"7\"");
  EXPECT_EQ(edited("\xEF\xBB\xBF"
                   "a: 1\r\nb: 2\r\n",
                   at({"a"}, scalar("5"))),
            "\xEF\xBB\xBF"
            "a: 5\r\nb: 2\r\n");
}

TEST(Edit, BehindAnAliasTheValueIsWrittenWhereTheAliasStands) {
  const std::string text = "p: &p {x: 1, y: 2}\nA: {at: *p}\nB:\n  at: *p\n";
  EXPECT_EQ(edited(text, at({"B", "at", "y"}, scalar("9"))),
            "p: &p {x: 1, y: 2}\nA: {at: *p}\nB:\n  at: {x: 1, y: 9}\n");
  // What an anchor names changes only there: its aliases mean what they meant.
  EXPECT_EQ(edited(text, at({"p", "x"}, scalar("5"))),
            "p: &p {x: 5, y: 2}\nA: {at: {x: 1, y: 2}}\nB:\n  at: {x: 1, y: 2}\n");
}

TEST(Edit, MissingKeysAreAddedInTheStyleOfTheirMap) {
  Change place;
  place.key("x").scalar = "1";
  EXPECT_EQ(edited("A:\n  name: A  # first\n  mass: 1\nB: 2\n", at({"A", "at"}, place)),
            "A:\n  name: A  # first\n  mass: 1\n  at: {x: 1}\nB: 2\n");
  EXPECT_EQ(edited("A: {name: A}\n", at({"A", "at"}, place)), "A: {at: {x: 1}, name: A}\n");
  EXPECT_EQ(edited("A: {}\n", at({"A", "at"}, place)), "A: {at: {x: 1}}\n");
  EXPECT_EQ(edited("A:\n  name: A\n  at:\n  b: 1\n", at({"A", "at"}, place)), "A:\n  name: A\n  at: {x: 1}\n  b: 1\n");
  EXPECT_EQ(edited("A:\r\n  name: A\r\nB: 1\r\n", at({"A", "b"}, scalar("2"))),
            "A:\r\n  name: A\r\n  b: 2\r\nB: 1\r\n");
}

TEST(Edit, ItemsLeaveListsOfEitherStyle) {
  const auto without = [](std::set<std::string> names) {
    Change list;
    list.without = std::move(names);
    return at({"l"}, list);
  };
  EXPECT_EQ(edited("l: [A, B, C]\n", without({"B"})), "l: [A, C]\n");
  EXPECT_EQ(edited("l: [A, B, C]\n", without({"B", "C"})), "l: [A]\n");
  EXPECT_EQ(edited("l: [A, B, C]\n", without({"A", "B", "C"})), "l: []\n");
  EXPECT_EQ(edited("l:\n- A  # a\n- B\n# then\n- 'C'\n", without({"A", "C"})), "l:\n- B\n# then\n");
  EXPECT_EQ(edited("l:\n  - A\nm: 1\n", without({"A"})), "l:\nm: 1\n");
}

TEST(Edit, WhatWouldNotReadBackIsRefused) {
  EXPECT_EQ(edited("a: |\n  many\n  lines\n", at({"a"}, scalar("1"))),
            "refused: text over several lines is not edited");
  EXPECT_EQ(edited("a: many\n  lines\nb: 1\n", at({"a"}, scalar("1"))),
            "refused: the text would not read back as what is wanted");
  EXPECT_EQ(edited("a: [1]\n", at({"a"}, scalar("1"))), "refused: expected one value, found several");
  EXPECT_EQ(edited("a: b\n", at({"a"}, scalar("#x: [y"))), "a: \"#x: [y\"\n");
}

constexpr const char* kModel = R"(# A model of mine.
adf version: 1.0
namespace: /t/
bodies: [BODY A, "BODY B"] # both
joints:
  - JOINT J  # between them
my key: {kept: yes}
BODY Z: {name: not listed}
BODY A:
  name: A
  mass: 1.0        # kg
  location:
    position: {x: 0.10, y: 0.2, z: 0.3}
    orientation: {r: 0, p: 0, y: 0}
  unknown: 7
BODY B: &b {name: B, mass: 2}
JOINT J: {name: J, parent: BODY A, child: BODY B, type: fixed, parent pivot: {x: 0, y: 0, z: 0},
  child pivot: {x: 0, y: 0, z: 0}, parent axis: {x: 0, y: 0, z: 1}, child axis: {x: 0, y: 0, z: 1}}
)";

SavedModel save(const std::string& text, std::vector<BodyPlace> places, const scene::Model* present = nullptr) {
  SaveOrder order{text, "model.yaml", "other.yaml", present, {}};
  order.present.bodies = std::move(places);
  return save_model(order);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Save, ABodyThatMovedChangesItsOwnLineOnly) {
  math::Pose place{{0.1, 0.2, 0.75}, {}};
  SavedModel saved = save(kModel, {{"BODY A", place}, {"BODY B", {}}});
  ASSERT_TRUE(saved.text) << all_of(saved.diagnostics);
  EXPECT_EQ(*saved.text, replaced(kModel, "z: 0.3}", "z: 0.75}"));
  // A body without a location gets one; another turn changes the angles that differ.
  place.orientation = math::from_rpy(0.0, 0.0, 0.25);
  saved = save(kModel, {{"BODY A", place}, {"BODY B", {{0, 0, 1}, {}}}});
  ASSERT_TRUE(saved.text) << all_of(saved.diagnostics);
  EXPECT_EQ(*saved.text, replaced(replaced(replaced(kModel, "z: 0.3}", "z: 0.75}"), "y: 0}\n  unk", "y: 0.25}\n  unk"),
                                  "{name: B,", "{location: {position: {x: 0, y: 0, z: 1}}, name: B,"));
}

TEST(Save, PlacesReadBackAlsoNearTheSingularityOfAngles) {
  for (int i = 0; i < 2000; ++i) {
    const double t = i;
    math::Pose place{{std::sin(t), 1e-3 * t, -std::cos(t)}, math::from_rpy(3 * std::sin(7 * t), 1.5707963267948966, t)};
    if (i % 2 == 0) place.orientation = math::from_rpy(3 * std::sin(7 * t), 3 * std::cos(5 * t), t);
    const SavedModel saved = save(kModel, {{"BODY A", place}, {"BODY B", place}});
    ASSERT_TRUE(saved.text) << all_of(saved.diagnostics);
    const ModelResult again = parse(*saved.text);
    for (const scene::Body& body : again.model->bodies) {
      EXPECT_LT(math::norm(body.T_world_body.position - place.position), 1e-9);
      const math::Quat off = math::inverse(body.T_world_body.orientation) * place.orientation;
      EXPECT_LT(math::norm(math::log(off)), 1e-9) << i;
    }
  }
}

TEST(Save, WhatWasRemovedLeavesItsListAndItsBlockStays) {
  scene::Model present = *parse(kModel).model;
  present.bodies.pop_back();
  present.joints.clear();
  const SavedModel saved = save(kModel, {}, &present);
  ASSERT_TRUE(saved.text) << all_of(saved.diagnostics);
  EXPECT_EQ(*saved.text, replaced(replaced(kModel, ", \"BODY B\"]", "]"), "  - JOINT J  # between them\n", ""));
  EXPECT_EQ(parse(*saved.text).model->bodies.size(), 1u);
}

class SavedElsewhere : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ambf_save_test_" + std::to_string(getpid()));
    fs::create_directories(folder_ / "models/meshes/low");
    fs::create_directories(folder_ / "saved");
    for (const char* file : {"meshes/a.obj", "meshes/low/a.obj", "b.obj"}) std::ofstream(folder_ / "models" / file);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(SavedElsewhere, RelativePathsLeadToTheSameFiles) {
  const std::string head = "namespace: /t/\nbodies: [A, B]\n";
  const std::string blocks =
      "A: {name: A, mass: 1, mesh: a.obj}\nB: {name: B, mass: 1, mesh: a.obj, high resolution path: ./meshes}\n";
  const std::string from = folder_ / "models/m.yaml", to = folder_ / "saved/m.yaml";
  const std::string text = head + "high resolution path: ./meshes/\nlow resolution path: meshes/low\n" + blocks;
  SavedModel saved = save_model({text, from, to, nullptr, {}});
  ASSERT_TRUE(saved.text) << all_of(saved.diagnostics);
  EXPECT_EQ(*saved.text, head +
                             "high resolution path: ../models/meshes/\nlow resolution path: ../models/meshes/low/\n" +
                             replaced(blocks, "./meshes}", "../models/meshes/}"));
  const ModelResult before = parse_model(text, from), after = parse_model(*saved.text, to);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.model->bodies[i].visual.mesh_file, before.model->bodies[i].visual.mesh_file);
    EXPECT_EQ(after.model->bodies[i].collision.mesh_file, before.model->bodies[i].collision.mesh_file);
  }
  // Without a folder in the header, it gets one; within one folder, nothing changes.
  const std::string plain = head + "B: {name: B, mass: 1, mesh: b.obj}\nA: {name: A, mass: 1}\n";
  saved = save_model({plain, from, to, nullptr, {}});
  ASSERT_TRUE(saved.text) << all_of(saved.diagnostics);
  EXPECT_EQ(*saved.text, replaced(plain, "/t/\n", "/t/\nhigh resolution path: ../models/\n"));
  EXPECT_EQ(*save_model({text, from, folder_ / "models/n.yaml", nullptr, {}}).text, text);
}

// Of every file that loads: unchanged it is written byte for byte; a body that moved changes lines of its block alone.
void check_folder(const fs::path& folder, std::size_t at_least) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string path = entry.path().string();
    const ModelResult model = load_model(path);
    if (!model.model || !model.text) continue;
    ++files;
    SaveOrder order{*model.text, path, path, &*model.model, {}};
    for (const scene::Body& body : model.model->bodies)
      order.present.bodies.push_back({body.identity.identifier, body.T_world_body});
    const SavedModel same = save_model(order);
    ASSERT_TRUE(same.text) << path << all_of(same.diagnostics);
    std::ifstream stream(path, std::ios::binary);
    EXPECT_EQ(*same.text, std::string(std::istreambuf_iterator<char>(stream), {})) << path;
    if (order.present.bodies.empty() || !model.document->root().find(order.present.bodies.back().block)) continue;
    order.present.bodies.back().T_world_body.position.z += 0.125;
    const SavedModel moved = save_model(order);
    ASSERT_TRUE(moved.text) << path << all_of(moved.diagnostics);
    EXPECT_NE(*moved.text, *same.text) << path;
    const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    EXPECT_LE(lines(*moved.text) - lines(*same.text), 1) << path;
    std::size_t different = 0;
    std::istringstream a(*same.text), b(*moved.text);
    for (std::string x, y; std::getline(a, x) && std::getline(b, y);)
      if (x != y && ++different == 1 && lines(*moved.text) > lines(*same.text)) std::getline(b, y);  // a line was added
    EXPECT_LE(different, 1u) << path;
  }
  EXPECT_GE(files, at_least);
}

TEST(Save, OwnModelsStayAsTheyAreByteForByte) { check_folder(fs::path(AMBF_SOURCE_DIR) / "ambf_models", 20); }

TEST(Save, FilesOfOthersStayAsTheyAreByteForByte) {
  AMBF_NEEDS_COMPAT();
  check_folder(compat::folder(), 20);
}

}  // namespace
}  // namespace ambf::adf
