#include "render/window/keys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "render/marks/layers.h"

namespace ambf::render {
namespace {

TEST(Keys, ThoseOfTheReferenceDoWhatItSays) {
  const Modifiers plain, control{true, false, false}, alt{false, true, false};
  EXPECT_EQ(action_of("Esc", plain, false), Action::quit);
  EXPECT_EQ(action_of("Q", plain, false), Action::quit);
  EXPECT_EQ(action_of("H", plain, false), Action::help);
  EXPECT_EQ(action_of("Space", plain, false), Action::step_once);
  EXPECT_EQ(action_of("Space", control, false), Action::step_ten);
  EXPECT_EQ(action_of("P", control, false), Action::pause);
  EXPECT_EQ(action_of("P", plain, false), Action::picking);
  EXPECT_EQ(action_of("R", control, false), Action::reset_bodies);
  EXPECT_EQ(action_of("R", alt, false), Action::reset_world);
  EXPECT_EQ(action_of("R", plain, false), Action::none);
  EXPECT_EQ(action_of("V", control, false), Action::reset_cameras);
  EXPECT_EQ(action_of("V", plain, false), Action::layer);
  EXPECT_EQ(binding_of("V", plain, false)->layer, LayerId::frames);
  EXPECT_EQ(action_of("1", plain, false), Action::gravity_on);
  EXPECT_EQ(action_of("2", plain, false), Action::gravity_off);
  EXPECT_EQ(action_of("X", control, false), Action::remove_picked);
  EXPECT_EQ(action_of("F", plain, false), Action::full_screen);
}

TEST(Keys, OnlyStepsAndGainsRepeatWhileHeld) {
  EXPECT_EQ(action_of("7", {}, true), Action::device_gain);
  EXPECT_EQ(action_of("N", {}, true), Action::none);
  EXPECT_EQ(action_of("Space", {}, true), Action::step_once);
  EXPECT_EQ(action_of("P", {true, false, false}, true), Action::none);
  EXPECT_EQ(action_of("F", {}, true), Action::none);
}

TEST(Keys, NoKeyIsGivenTwice) {
  std::set<std::string> names;
  for (const KeyBinding& binding : key_bindings())
    EXPECT_TRUE(names.insert(name_of(binding)).second) << name_of(binding);
}

TEST(Keys, HelpNamesEveryKeyWithWhatItDoes) {
  const std::vector<std::string> lines = help_lines();
  for (const KeyBinding& binding : key_bindings()) {
    if (binding.action == Action::later) continue;
    const bool found = std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.rfind(name_of(binding) + " ", 0) == 0 && line.find(binding.text) != std::string::npos;
    });
    EXPECT_TRUE(found) << name_of(binding);
  }
}

TEST(Keys, ThoseForWhatIsStillToComeSayWhatTheyAreFor) {
  EXPECT_EQ(action_of("T", {}, false), Action::later);
  EXPECT_NE(later_text("T", {}).find("devices"), std::string::npos);
  EXPECT_EQ(later_text("H", {}), "");
  EXPECT_EQ(later_text("PgUp", {}), "");
}

// With AMBF_UPDATE_DOCS set, the page is written instead.
TEST(Keys, TheirPageInTheDocumentationIsNotStale) {
  const std::string path = std::string(AMBF_SOURCE_DIR) + "/docs/keys.md";
  if (std::getenv("AMBF_UPDATE_DOCS") != nullptr) std::ofstream(path) << keys_document();
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), keys_document()) << "run this test once with AMBF_UPDATE_DOCS=1";
}

TEST(Keys, EveryLayerHasAKeyOfItsOwnThatSwitchesIt) {
  for (std::size_t i = 0; i < all_layers().size(); ++i) {
    const auto switches = [&](const KeyBinding& binding) {
      return binding.action == Action::layer && binding.layer == static_cast<LayerId>(i);
    };
    EXPECT_EQ(std::count_if(key_bindings().begin(), key_bindings().end(), switches), 1) << all_layers()[i].label;
  }
}

TEST(Keys, NoTwoLayersHaveTheSameLabelOrKey) {
  LayerInfo layer = all_layers()[static_cast<std::size_t>(LayerId::joints)];
  layer.key.clear();
  EXPECT_THROW(add_layer(layer), std::logic_error) << layer.label;
  layer.label = "Another";
  layer.key = "J";
  EXPECT_THROW(add_layer(layer), std::logic_error) << layer.key;
}

}  // namespace
}  // namespace ambf::render
