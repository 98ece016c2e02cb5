// URDF as it is found: odd but legal files load, what does not is refused with its line and a reason that helps.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "adf/adf.h"
#include "adf/detail/urdf_text.h"
#include "adf/urdf_import.h"

namespace ambf::adf {
namespace {

std::string messages(const ModelResult& result) {
  std::string text;
  for (const base::Diagnostic& d : result.diagnostics) text += base::to_string(d) + "\n";
  return text;
}

std::string link(const std::string& name, const std::string& more = {}) {
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"1\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" "
         "izz=\"0.1\"/></inertial>" +
         more + "</link>\n";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& more = {}) {
  return "<joint name=\"" + name + "\" type=\"continuous\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/>" + more + "</joint>\n";
}

std::string robot(const std::string& body) { return "<robot name=\"r\">\n" + body + "</robot>\n"; }

const std::string kTwo = link("a") + link("b") + joint("j", "a", "b");

ModelResult read(const std::string& text) { return parse_model(text, "r.urdf"); }

std::string as_utf16(const std::string& ascii, bool big_endian, bool mark) {
  std::string out = !mark ? "" : big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) out += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return out;
}

TEST(UrdfOddities, EncodingsAndWhatStandsBeforeTheRobot) {
  const std::string declared = "<?xml version=\"1.0\" encoding=\"UTF-16\"?>\n";
  for (const std::string& text :
       {robot(kTwo), "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n" + robot(kTwo), "\n\n  " + robot(kTwo),
        as_utf16(declared + robot(kTwo), false, true), as_utf16(declared + robot(kTwo), true, true),
        as_utf16(declared + robot(kTwo), false, false),
        "<?xml version=\"1.0\"?>\n<!DOCTYPE robot [\n<!ENTITY x \"y\">\n]>\n" + robot(kTwo),
        "<!-- <xacro:property name=\"x\"/> -->\n" + robot(kTwo + "<!-- <link name=\"c\"/> --><![CDATA[ ]]>")}) {
    const ModelResult result = read(text);
    ASSERT_TRUE(result.model.has_value()) << text << messages(result);
    EXPECT_FALSE(base::has_errors(result.diagnostics)) << messages(result);
    EXPECT_EQ(result.model->bodies.size(), 2u);
    EXPECT_EQ(result.model->joints.size(), 1u);
  }
  const ModelResult latin = read("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n" + robot(link("\xE9")));
  ASSERT_TRUE(latin.model.has_value()) << messages(latin);
  EXPECT_EQ(latin.model->bodies.front().identity.name, "\xC3\xA9");
  EXPECT_EQ(urdf::as_utf8(std::string("\xFF\xFE\x3D\xD8\x00\xDE", 6)), "\xF0\x9F\x98\x80") << "two units, one letter";
}

TEST(UrdfOddities, NamesOfAnyKind) {
  for (const char* each :
       {"two words", "c.d", "x/y", "\xE4\xB8\x96", "#h: {", "it's", "bodies", "joints", "name", "adf version", "~"}) {
    const std::string name = each;
    const ModelResult result = read(robot(link("a") + link(name) + joint("j " + name, "a", name)));
    ASSERT_TRUE(result.model.has_value()) << name << messages(result);
    EXPECT_FALSE(base::has_errors(result.diagnostics)) << name << messages(result);
    ASSERT_EQ(result.model->bodies.size(), 2u) << name;
    EXPECT_EQ(result.model->joints.at(0).child, "BODY " + name);
  }
}

TEST(UrdfOddities, WhatIsRefusedHasItsLineAndReason) {
  const auto refused = [](const std::string& text, const std::string& place, const std::string& reason) {
    const ModelResult result = read(text);
    EXPECT_FALSE(result.model.has_value()) << text;
    EXPECT_NE(messages(result).find("r.urdf:" + place), std::string::npos) << place << "\n" << messages(result);
    EXPECT_NE(messages(result).find(reason), std::string::npos) << reason << "\n" << messages(result);
  };
  refused(robot(link("a") + "<xacro:box/>"), "3", "macros of xacro");
  refused(robot(link("a") + link("b&#10;c") + joint("j", "a", "b&#10;c")), "3", "link 'b?c'");
  refused(robot(link("a") + link("b") + link("c") + joint("j", "a", "c") + joint("k", "b", "c") + joint("l", "a", "b")),
          "6", "is the child of two joints");
  refused("<robot name=\"r\">\n<link name=\"a\">\n", "3", "Error reading");
  std::string deep = robot(link("a"));
  for (int i = 0; i < 300; ++i) deep.insert(deep.find("</robot>"), "\n<g>");
  refused(deep, "2", "nested more than 200 deep");
  refused("<?xml version=\"1.0\"?><sdf version=\"1.6\"/>", "1:1", "first element is `sdf`");
  refused("<mujoco><worldbody/></mujoco>", "1:1", "first element is `mujoco`");
  refused("<?xml version=\"1.0\"?>\n", "1:1", "XML without an element");
}

TEST(UrdfOddities, WhatUrdfdomLeavesOutIsTold) {
  const auto told = [](const std::string& text, const std::string& what) {
    const ModelResult result = read(text);
    ASSERT_TRUE(result.model.has_value()) << messages(result);
    EXPECT_NE(messages(result).find(what), std::string::npos) << what << "\n" << messages(result);
  };
  const auto drawn = [](const std::string& material) {
    return robot(link("a", "<visual><geometry><box size=\"1 1 1\"/></geometry>" + material + "</visual>"));
  };
  told(drawn("<material name=\"m\"><color rgba=\"#ff0000\"/></material>"), "rgba` is not four numbers");
  told(drawn("<material name=\"m\"><color rgba=\"1 0 0\"/></material>"), "rgba` is not four numbers");
  told(drawn("<material name=\"nowhere\"/>"), "materials that nothing defines");
  told(robot(link("a") + link("b") + joint("j", "a", "b", "<axis xyz=\"0 0 0\"/>")), "the axis of joint 'j'");
  const ModelResult fine = read(drawn("<material name=\"m\"><color rgba=\"1 0 0 1\"/></material>"));
  EXPECT_EQ(messages(fine).find("rgba"), std::string::npos) << messages(fine);
}

}  // namespace
}  // namespace ambf::adf
