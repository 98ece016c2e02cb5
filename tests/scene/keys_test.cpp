#include "scene/keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "scene/block_kinds.h"
#include "scene/description.h"

namespace ambf::scene {
namespace {

bool needs_sub(KeyType type) {
  return type == KeyType::map || type == KeyType::maps || type == KeyType::number_or_map ||
         type == KeyType::text_or_map || type == KeyType::vector_or_map;
}

TEST(Keys, NoGroupNamesAKeyTwice) {
  for (const Group* group : all_groups()) {
    std::set<std::string_view> seen;
    for (const Key* key : keys_of(*group)) {
      EXPECT_TRUE(seen.insert(key->name).second) << group->title << ": " << key->name;
    }
  }
}

TEST(Keys, EveryGroupThatAKeyOrAKindNamesIsShown) {
  const std::vector<const Group*> shown = all_groups();
  const auto is_shown = [&](const Group* group) { return std::find(shown.begin(), shown.end(), group) != shown.end(); };
  std::set<std::string_view> titles;
  for (const Group* group : shown) {
    EXPECT_TRUE(titles.insert(group->title).second) << group->title;
    for (const Key* key : keys_of(*group)) {
      EXPECT_EQ(needs_sub(key->type), key->sub != nullptr) << group->title << ": " << key->name;
      EXPECT_EQ(key->type == KeyType::choice, !key->words.empty()) << group->title << ": " << key->name;
      if (key->sub != nullptr) {
        EXPECT_TRUE(is_shown(key->sub)) << group->title << ": " << key->name;
      }
    }
  }
  for (const BlockKind* kind : block_kinds()) {
    EXPECT_TRUE(is_shown(kind->group)) << kind->list.name;
    EXPECT_TRUE(kind->group->is_block) << kind->list.name;
    EXPECT_NE(find_key(group::kModel, kind->list.name), nullptr) << kind->list.name;
  }
}

TEST(Keys, OtherSpellingsNameTheKeyThatGoesBeforeThem) {
  for (const Group* group : all_groups()) {
    for (const Key* key : keys_of(*group)) {
      if (key->status == KeyStatus::older) {
        EXPECT_FALSE(key->preferred.empty()) << key->name;
      }
      if (key->preferred.empty()) continue;
      const Key* preferred = find_key(*group, key->preferred);
      ASSERT_NE(preferred, nullptr) << key->name;
      EXPECT_EQ(preferred->type, key->type) << key->name;
      EXPECT_EQ(preferred->member.find, key->member.find) << key->name;
    }
  }
}

TEST(Keys, SharedKeysAreFoundInEveryBlockThatIncludesThem) {
  EXPECT_NE(find_key(group::kBody, "publish frequency"), nullptr);
  EXPECT_NE(find_key(group::kCamera, "publish frequency"), nullptr);
  EXPECT_EQ(find_key(group::kCamera, "mass"), nullptr);
  EXPECT_NE(other_blocks_with("mass", group::kCamera).find("body"), std::string::npos);
}

// What the keys of a group fill; null where none is bound.
const void* owner_type(const Group& group) {
  for (const Key& key : group.keys) {
    if (key.member) return key.member.owner;
    if (fills_owner(key)) return owner_type(*key.sub);
  }
  return nullptr;
}

TEST(Bindings, OfOneGroupFillOneDescriptionAndThoseOfItsMapsWhatTheyAreBoundTo) {
  for (const Group* group : all_groups()) {
    for (const Key& key : group->keys) {
      const std::string where = std::string(group->title) + ": " + std::string(key.name);
      if (fills_owner(key)) {
        EXPECT_EQ(owner_type(*key.sub), owner_type(*group)) << where;
      }
      if (!key.member) continue;
      EXPECT_EQ(key.member.owner, owner_type(*group)) << where;
      const Member member = key.member.find(const_cast<void*>(key.member.unchanged()));
      if (const auto* inner = std::get_if<InnerMember>(&member)) {
        EXPECT_EQ(inner->type, owner_type(*key.sub)) << where;
      }
    }
  }
}

TEST(Bindings, AreOfTheTypeThatTheirKeySays) {
  const auto fits = [](KeyType type, const Member& member) {
    const auto is = [&member](auto... pointers) { return (std::holds_alternative<decltype(pointers)>(member) || ...); };
    using Vector = math::Vec3*;
    using Numbers = std::optional<double>*;
    switch (type) {
      case KeyType::boolean: return is(static_cast<bool*>(nullptr));
      case KeyType::integer: return is(static_cast<int*>(nullptr), static_cast<unsigned*>(nullptr));
      case KeyType::number: return is(static_cast<double*>(nullptr), Numbers{});
      case KeyType::text: return is(static_cast<std::string*>(nullptr));
      case KeyType::choice: return is(static_cast<std::string*>(nullptr), EnumMember{});
      case KeyType::vector: return is(Vector{}, static_cast<std::optional<math::Vec3>*>(nullptr));
      case KeyType::number_or_vector: return is(Vector{});
      case KeyType::map:
        return is(Vector{}, static_cast<math::Pose*>(nullptr), static_cast<std::optional<math::Pose>*>(nullptr),
                  InnerMember{});
      case KeyType::texts: return is(static_cast<std::vector<std::string>*>(nullptr));
      default: return false;
    }
  };
  for (const Group* group : all_groups()) {
    for (const Key& key : group->keys) {
      if (!key.member) continue;
      const Member member = key.member.find(const_cast<void*>(key.member.unchanged()));
      EXPECT_TRUE(fits(key.type, member)) << group->title << ": " << key.name;
    }
  }
}

TEST(Defaults, AreThoseOfTheDescription) {
  EXPECT_EQ(default_in(group::kBody, *find_key(group::kBody, "mass")), "1");
  EXPECT_EQ(default_in(group::kCollision, *find_key(group::kCollision, "collision mesh type")), "CONCAVE_MESH");
  EXPECT_EQ(default_in(group::kLight, *find_key(group::kLight, "location")), "0, 0, 5");
  EXPECT_EQ(default_in(group::kCamera, *find_key(group::kCamera, "publish depth interval")), "10");
  EXPECT_EQ(default_in(group::kBody, *find_key(group::kBody, "passive")), "false");  // of an included group
}

// A changed description changes what docs and schema show of it.
TEST(Defaults, ThatAreChangedAreShownByDocsAndSchema) {
  Defaults defaults;
  Body body;
  body.surface.friction = 0.625;
  defaults.set(body);
  const auto differs_in = [](const std::string& now, const std::string& before, const std::string& line) {
    return now.find(line) != std::string::npos && before.find(line) == std::string::npos;
  };
  EXPECT_TRUE(
      differs_in(keys_as_markdown(defaults), keys_as_markdown(), "| `static` | a number |  | 0.625 | Sliding."));
  EXPECT_TRUE(differs_in(keys_as_json_schema(defaults), keys_as_json_schema(), "Sliding. Default: 0.625."));
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
