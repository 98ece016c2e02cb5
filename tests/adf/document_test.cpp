#include "adf/document.h"

#include <gtest/gtest.h>

#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

TEST(Document, MarksCountFromOneAndAliasesStandWhereTheyAreWritten) {
  const Document document("a: &x 1\nb:\n  c: *x\n");
  const Value root = document.root();
  EXPECT_EQ(root.find("a")->mark().line, 1);
  EXPECT_EQ(root.find("a")->mark().column, 4);
  const Value alias = *root.find("b")->find("c");
  EXPECT_EQ(alias.text(), "1");
  EXPECT_EQ(alias.mark().line, 3);
  EXPECT_EQ(alias.mark().column, 6);
  EXPECT_TRUE(alias.anchored());
}

TEST(Document, RepeatedKeysAreAllKeptAndTheFirstIsFound) {
  const Document document("{a: 1, a: 2}");
  EXPECT_EQ(document.root().size(), 2u);
  EXPECT_EQ(document.root().find("a")->text(), "1");
}

TEST(Document, AModelKeepsItsFileAndWhichKeysWereGiven) {
  const ModelResult result = parse("bodies: [A]\nA:\n  name: A\n  mass: 2\n");
  ASSERT_TRUE(result.document);
  const auto body = result.document->root().find("A");
  ASSERT_TRUE(body);
  ASSERT_TRUE(body->find("mass"));
  EXPECT_EQ(body->find("mass")->mark().line, 4);
  EXPECT_FALSE(body->find("friction"));
  EXPECT_FALSE(parse("bodies: [A\n").document);
}

TEST(Document, CyclicAliasIsAnErrorWithItsPlace) {
  const Document document("a: &x [1, *x]\n");
  ASSERT_TRUE(document.error());
  EXPECT_EQ(document.error()->mark.line, 1);
  EXPECT_EQ(document.error()->mark.column, 11);
  EXPECT_NE(document.error()->message.find("never end"), std::string::npos);
}

TEST(Document, ExplodingAliasesAreRefusedEarly) {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) text += before + (k < 9 ? " , " : " ]\n");
  }
  const Document document(text);
  ASSERT_TRUE(document.error());
  EXPECT_NE(document.error()->message.find("aliases expand"), std::string::npos) << document.error()->message;
}

TEST(Document, DeepNestingIsRefused) {
  for (const auto& [open, close] : {std::pair{"[", "]"}, {"{a: ", "}"}, {"- ", ""}}) {
    std::string text;
    for (int i = 0; i < 200; ++i) text += open;
    text += "1";
    for (int i = 0; i < 200; ++i) text += close;
    EXPECT_TRUE(Document(text).error()) << open;
  }
  std::string huge(500'000, '[');
  EXPECT_TRUE(Document(huge).error());
}

TEST(Document, HugeFilesAreRefused) {
  EXPECT_TRUE(Document(std::string(limits::kFileBytes + 1, ' ')).error());
  std::string many = "[";
  for (std::size_t i = 0; i <= limits::kNodes; ++i) many += "1,";
  ASSERT_TRUE(Document(many + "1]").error());
  EXPECT_NE(Document(many + "1]").error()->message.find("values in one file"), std::string::npos);
}

TEST(Document, OnlyTheFirstDocumentCounts) {
  const Document document("a: 1\n---\nb: 2\n");
  EXPECT_TRUE(document.root().find("a"));
  EXPECT_TRUE(document.has_more_documents());
  EXPECT_FALSE(Document("a: 1\n").has_more_documents());
}

TEST(Document, BrokenTextsEndInAnError) {
  for (const char* text : {"[", "{", "[:", "{:", "a: b: c", "\"", "'", "&", "*x", "!<", "%", "@", "`", "a: [}", "? [",
                           "\t- a\n\tb", "|\n a\n  b\n c"}) {
    const Document document(text);
    EXPECT_TRUE(document.error() || !document.root().is_map() || document.root().size() > 0) << text;
  }
}

}  // namespace
}  // namespace ambf::adf
