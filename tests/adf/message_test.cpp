// Every message names file, line, column, block, key, what was expected and what was found (promise PR10).
#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

TEST(Message, SyntaxErrorNamesLineAndColumnAndRefusesTheFile) {
  const ModelResult result = parse("bodies: [A]\nA: {name: A\n");
  EXPECT_FALSE(result.model);
  EXPECT_TRUE(says(result.diagnostics, "^model.yaml:[0-9]+:[0-9]+: error: YAML syntax error: "));
}

TEST(Message, WrongTypeNamesWhatWasExpectedAndFoundAndDropsTheBlockOnly) {
  const ModelResult result = parse("bodies: [A, B]\nA:\n  name: A\n  mass: heavy\nB: {name: B, mass: 1}\n");
  ASSERT_TRUE(result.model);
  ASSERT_EQ(result.model->bodies.size(), 1u);
  EXPECT_EQ(result.model->bodies[0].identity.name, "B");
  EXPECT_TRUE(
      says(result.diagnostics, "^model.yaml:4:9: error: \\[A: mass\\] expected a number, found the text 'heavy'"));
}

TEST(Message, EveryWrongValueOfABlockIsTold) {
  const ModelResult result = parse_body_keys(
      "mass: -1, restitution: .nan, scale: 0, passive: 2, collision groups: [a], location: {position: {x: 1, y: 2}}, "
      "inertia: 5");
  EXPECT_TRUE(result.model->bodies.empty());
  EXPECT_TRUE(says(result.diagnostics, "\\[BODY A: mass\\] expected a number of at least 0, found the number -1"));
  EXPECT_TRUE(says(result.diagnostics, "\\[BODY A: restitution\\] expected a finite number, found '.nan'"));
  EXPECT_TRUE(says(result.diagnostics, "\\[BODY A: scale\\] expected a number above 0, found the number 0"));
  EXPECT_TRUE(says(result.diagnostics, "\\[BODY A: passive\\] expected true or false, found the number 2"));
  EXPECT_TRUE(
      says(result.diagnostics, "\\[BODY A: collision groups\\[0\\]\\] expected a whole number, found the text 'a'"));
  EXPECT_TRUE(
      says(result.diagnostics, "\\[BODY A: location/position\\] expected a vector \\{x, y, z\\}, found no `z`"));
  EXPECT_TRUE(says(result.diagnostics, "\\[BODY A: inertia\\] expected a map, found the number 5"));
  EXPECT_EQ(count(result.diagnostics, base::Severity::error), 7u);
}

TEST(Message, InfinityIsRefusedHoweverItIsWritten) {
  EXPECT_TRUE(
      says(parse_body_keys("mass: .inf").diagnostics, "\\[BODY A: mass\\] expected a finite number, found '.inf'"));
  EXPECT_TRUE(
      says(parse_body_keys("mass: 1e999").diagnostics, "\\[BODY A: mass\\] expected a finite number, found '1e999'"));
}

TEST(Message, WhatLiesOutOfBoundsIsAnErrorAtItsLine) {
  const auto refused = [](const std::string& keys, const std::string& expression) {
    const ModelResult result = parse_body_keys(keys);
    EXPECT_TRUE(result.model->bodies.empty()) << keys;
    EXPECT_TRUE(says(result.diagnostics, "^model.yaml:3:[0-9]+: error: \\[BODY A: " + expression)) << keys;
  };
  refused("mass: 1, location: {position: {x: 0, y: 0, z: 1e308}}",
          "location/position/z\\] expected a number of at most 1e\\+06 m, found the number 1e\\+308");
  refused("mass: 1e300", "mass\\] expected a number of at most 1e\\+09 kg");
  refused("mass: 1e-300", "mass\\] expected a number of at least 1e-09 kg");
  refused("mass: 1, scale: 1e7", "scale\\] expected a number of at most 1e\\+06,");
  refused("mass: 1, inertia: {ix: 1, iy: 1, iz: 1e200}", "inertia/iz\\] expected a number of at most 1e\\+12 kg m");
  refused("mass: 1, controller: {linear: {P: -1e13}}", "controller/linear/P\\] expected a number of at most 1e\\+12");
  const ModelResult good = parse_body_keys(
      "mass: 1e-9, scale: 1e6, location: {position: {x: -1e6, y: 1e6, z: 0}}, inertia: {ix: 1e12, iy: 1e12, iz: 1e12}");
  EXPECT_EQ(good.model->bodies.size(), 1u);
  EXPECT_TRUE(no_worse_than_information(good.diagnostics));
}

TEST(Message, UnknownKeyNamesTheNearestOne) {
  const ModelResult result = parse_body_keys("mass: 1, restituton: 0.5");
  EXPECT_EQ(result.model->bodies.at(0).surface.restitution, 0.1);
  EXPECT_TRUE(says(result.diagnostics,
                   "^model.yaml:3:[0-9]+: warning: \\[BODY A: restituton\\] unknown key; it has no effect \\(did you "
                   "mean `restitution`\\?\\)"));
}

TEST(Message, UnknownKeyInsideAMapIsFound) {
  EXPECT_TRUE(says(parse_body_keys("mass: 1, damping: {lin: 0.5}").diagnostics,
                   "warning: \\[BODY A: damping/lin\\] unknown key"));
}

TEST(Message, KeyOfAnotherKindOfBlockIsNamedAsSuch) {
  EXPECT_TRUE(says(parse_body_keys("mass: 1, joint limits: {low: 0, high: 1}").diagnostics,
                   "warning: \\[BODY A: joint limits\\] unknown key; it has no effect \\(it is a key of: joint\\)"));
}

TEST(Message, MergeKeysAreNotSilentlyIgnored) {
  EXPECT_TRUE(says(parse("d: &d {mass: 2}\nbodies: [A]\nA: {name: A, <<: *d}\n").diagnostics,
                   "warning: \\[A: <<\\] unknown key.*no merge keys"));
}

TEST(Message, RepeatedKeyWarnsAndTheFirstCounts) {
  const ModelResult result = parse("bodies: [A]\nA:\n  name: A\n  mass: 1\n  mass: 2\nA: {mass: 7}\n");
  EXPECT_EQ(result.model->bodies.at(0).mass, 1.0);
  EXPECT_TRUE(says(result.diagnostics,
                   "^model.yaml:5:3: warning: \\[A: mass\\] given twice; the first value counts \\(line 4\\)"));
  EXPECT_TRUE(
      says(result.diagnostics, "^model.yaml:6:1: warning: \\[A\\] given twice; the first one counts \\(line 2\\)"));
}

TEST(Message, AliasIsReportedWhereItStands) {
  EXPECT_TRUE(says(parse("heavy: &h heavy\nbodies: [A]\nA:\n  name: A\n  mass: *h\n").diagnostics,
                   "^model.yaml:5:9: error: \\[A: mass\\] expected a number, found the text 'heavy'"));
}

TEST(Message, ControlCharactersOfAFileDoNotReachTheTerminal) {
  const std::string text = all_of(parse("bodies: [\"A\\e[31m\\a\"]\n").diagnostics);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\a'), std::string::npos);
}

TEST(Message, AThousandFindingsAreEnough) {
  std::string text = "bodies: [A]\nA:\n  name: A\n";
  for (int i = 0; i < 3000; ++i) text += "  key" + std::to_string(i) + ": 1\n";
  text += "  mass: heavy\n";
  const ModelResult result = parse(text);
  EXPECT_EQ(result.diagnostics.size(), 1001u);
  EXPECT_TRUE(base::has_errors(result.diagnostics)) << "an error behind the last one shown must not get lost";
  EXPECT_TRUE(says(result.diagnostics, "further findings are not shown: 20[0-9][0-9], errors among them: 1"));
}

}  // namespace
}  // namespace ambf::adf
