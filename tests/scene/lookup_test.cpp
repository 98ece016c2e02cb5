#include "scene/lookup.h"

#include <gtest/gtest.h>

namespace ambf::scene {
namespace {

const std::vector<std::string> kArm{"/ambf/env/BODY Link1", "/ambf/env/BODY Link10", "/ambf/env/BODY Tool"};

TEST(Lookup, ExactIdentifierGoesBeforePartsOfOthers) {
  EXPECT_EQ(find_identifier(kArm, "/ambf/env/BODY Link1").index, 0u);
}

TEST(Lookup, UniquePartIsEnough) { EXPECT_EQ(find_identifier(kArm, "Tool").index, 2u); }

TEST(Lookup, PartOfSeveralFindsNoneAndNamesThem) {
  const Lookup found = find_identifier(kArm, "Link");
  EXPECT_FALSE(found.index);
  EXPECT_EQ(found.candidates, (std::vector<std::size_t>{0, 1}));
}

TEST(Lookup, WholeIdentifierBehindANamespaceGoesBeforeLongerOnes) {
  EXPECT_EQ(find_identifier(kArm, "BODY Link1").index, 0u);
}

TEST(Lookup, NameBehindThePrefixOfABlockGoesBeforeLongerOnes) {
  EXPECT_EQ(find_identifier({"/e/BODY Frame2", "/e/BODY Frame"}, "Frame").index, 1u);
}

TEST(Lookup, FirstSlashOfANamespaceMayBeMissingOnEitherSide) {
  EXPECT_EQ(find_identifier({"e/psm/BODY a", "e/psm/BODY ab"}, "/e/psm/BODY a").index, 0u);
  EXPECT_EQ(find_identifier({"/e/psm/BODY a", "/e/psm/BODY ab"}, "e/psm/BODY a").index, 0u);
}

TEST(Lookup, EmptyNameFindsNothing) { EXPECT_FALSE(find_identifier({"a"}, "").index); }

TEST(Lookup, JointBodyIsSoughtInItsOwnModelFirst) {
  const std::vector<std::string> own{"/a/BODY Base"}, world{"/b/BODY Base"};
  const Lookup found = find_joint_body(own, world, "BODY Base", "/a/", "");
  EXPECT_EQ(found.index, 0u);
  EXPECT_FALSE(found.in_world);
}

TEST(Lookup, JointNamespaceTellsAmbiguousBodiesApart) {
  const std::vector<std::string> own{"/a/BODY Base", "/b/BODY Base"};
  EXPECT_EQ(find_joint_body(own, {}, "BODY Base", "/b/", "").index, 1u);
}

TEST(Lookup, SecondCopyOfAModelFindsTheSecondCopyOfItsBodyInTheWorld) {
  const std::vector<std::string> world{"/a/BODY Base", "/a/BODY Base1"};
  const Lookup found = find_joint_body({}, world, "BODY Base", "/a/", "1");
  EXPECT_EQ(found.index, 1u);
  EXPECT_TRUE(found.in_world);
}

TEST(Lookup, BodyOfAnotherFileIsFoundByItsName) {
  const Lookup found = find_joint_body({"/a/X"}, {"/ambf/env/BODY Link7"}, "Link7", "/a/", "3");
  EXPECT_EQ(found.index, 0u);
  EXPECT_TRUE(found.in_world);
}

TEST(Namespace, BlockNamespaceIsAppendedOrReplaces) {
  EXPECT_EQ(join_namespace("/ambf/env/", "lights/"), "/ambf/env/lights/");
  EXPECT_EQ(join_namespace("/ambf/env/", "/other/"), "/other/");
  EXPECT_EQ(join_namespace("/ambf//env///", ""), "/ambf/env/");
  EXPECT_EQ(join_namespace("", ""), "");
}

TEST(Conflict, TheSmallestFreeNumberIsAppended) {
  EXPECT_EQ(conflict_number({"Box"}, "Ball"), "");
  EXPECT_EQ(conflict_number({"Box"}, "Box"), "1");
  EXPECT_EQ(conflict_number({"Box", "Box1", "Box3"}, "Box"), "2");
  EXPECT_EQ(conflict_number({"Box1"}, "Box1"), "1");  // Box11
}

TEST(Nearest, TypingErrorsAreRecognised) {
  const std::vector<std::string> keys{"mass", "mesh", "collision mesh type", "publish frequency"};
  EXPECT_EQ(nearest("mas", keys), "mass");
  EXPECT_EQ(nearest("Mass", keys), "mass");
  EXPECT_EQ(nearest("collision_mesh_type", keys), "collision mesh type");
  EXPECT_EQ(nearest("publish freqeuncy", keys), "publish frequency");
  EXPECT_EQ(nearest("gravity", keys), "");
  EXPECT_EQ(nearest(std::string(100000, 'm'), keys), "");
}

TEST(Nearest, TwoErrorsAreOneWordFromFiveLettersOn) {
  EXPECT_EQ(nearest("bodys", {"bodies", "joints"}), "bodies");
  EXPECT_EQ(nearest("bods", {"bodies", "joints"}), "");
  EXPECT_EQ(nearest("maze", {"mass"}), "");
}

TEST(Nearest, OneWordMayBeginTheOther) {
  EXPECT_EQ(nearest("std", {"mean", "std dev"}), "std dev");
  EXPECT_EQ(nearest("lower", {"high", "low"}), "low");
  EXPECT_EQ(nearest("publish", {"publish joint positions", "publish frequency"}), "publish frequency");
  EXPECT_EQ(nearest("ma", {"mass matrix"}), "");
  EXPECT_EQ(nearest("lowering", {"low", "lower"}), "lower");
}

}  // namespace
}  // namespace ambf::scene
