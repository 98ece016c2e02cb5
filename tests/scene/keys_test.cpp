#include "scene/keys.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

namespace ambf::scene {
namespace {

TEST(Keys, NoGroupNamesAKeyTwice) {
  for (const GroupInfo* info : all_groups()) {
    std::set<std::string_view> seen;
    for (const Key* key : keys_of(info->group)) {
      EXPECT_TRUE(seen.insert(key->name).second) << info->title << ": " << key->name;
    }
  }
}

TEST(Keys, EveryGroupThatAKeyOrAListNamesExists) {
  std::set<Group> used;
  for (const GroupInfo* info : all_groups()) {
    for (const Key* key : keys_of(info->group)) {
      if (key->sub != Group::none) used.insert(key->sub);
      const bool needs_sub = key->type == KeyType::map || key->type == KeyType::maps ||
                             key->type == KeyType::number_or_map || key->type == KeyType::text_or_map ||
                             key->type == KeyType::vector_or_map;
      EXPECT_EQ(needs_sub, key->sub != Group::none) << info->title << ": " << key->name;
      EXPECT_EQ(key->type == KeyType::choice, !key->choices.empty()) << info->title << ": " << key->name;
    }
  }
  for (const HeaderList& list : model_lists()) {
    used.insert(list.block);
    EXPECT_NE(find_key(Group::model, list.key), nullptr) << list.key;
    EXPECT_TRUE(group_info(list.block).is_block) << list.key;
  }
  for (Group group : used) EXPECT_EQ(group_info(group).group, group) << static_cast<int>(group);
}

TEST(Keys, OlderSpellingsNameTheOneThatReplacesThem) {
  for (const GroupInfo* info : all_groups()) {
    for (const Key* key : keys_of(info->group)) {
      if (key->status != KeyStatus::older) continue;
      const Key* newer = find_key(info->group, key->newer);
      ASSERT_NE(newer, nullptr) << key->name;
      EXPECT_EQ(newer->type, key->type) << key->name;
    }
  }
}

TEST(Keys, SharedKeysAreFoundInEveryBlockThatIncludesThem) {
  EXPECT_NE(find_key(Group::body, "publish frequency"), nullptr);
  EXPECT_NE(find_key(Group::camera, "publish frequency"), nullptr);
  EXPECT_EQ(find_key(Group::camera, "mass"), nullptr);
  EXPECT_NE(other_blocks_with("mass", Group::camera).find("body"), std::string::npos);
}

// The file in docs/ that `text` is written to; with AMBF_UPDATE_DOCS it is renewed.
void expect_current(const std::string& name, const std::string& text) {
  const std::string path = std::string(AMBF_SOURCE_DIR) + "/docs/" + name;
  if (std::getenv("AMBF_UPDATE_DOCS")) std::ofstream(path) << text;
  std::stringstream written;
  written << std::ifstream(path).rdbuf();
  EXPECT_EQ(written.str(), text) << "renew it: AMBF_UPDATE_DOCS=1 build/bin/ambf_scene_tests";
}

TEST(Keys, DocumentationIsWhatTheTableSays) { expect_current("adf.md", keys_as_markdown()); }

TEST(Keys, SchemaForEditorsIsWhatTheTableSays) { expect_current("adf.schema.json", keys_as_json_schema()); }

}  // namespace
}  // namespace ambf::scene
