// Descriptions written as ADF text read back as what they were.
#include "adf/write.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "adf/adf.h"
#include "same_model.h"
#include "some_model.h"

namespace ambf::adf {
namespace {

// AMBF_WRITE_SEEDS=10000 is the long run.
unsigned seeds() {
  const char* const wanted = std::getenv("AMBF_WRITE_SEEDS");
  return wanted == nullptr ? 200 : static_cast<unsigned>(std::atoi(wanted));
}

template <class Object>
void expect_all(const std::vector<Object>& a, const std::vector<Object>& b, unsigned seed) {
  ASSERT_EQ(a.size(), b.size()) << "seed " << seed;
  for (std::size_t i = 0; i < a.size(); ++i)
    test::Same{"seed " + std::to_string(seed) + " " + a[i].identity.identifier}(a[i], b[i]);
}

TEST(Write, WhatIsWrittenReadsBackAsWhatItWas) {
  Options options;
  options.look_for_files = false;
  for (unsigned seed = 0; seed < seeds(); ++seed) {
    const scene::Model model = test::Some(seed).model();
    const WrittenModel written = write_model(model);
    ASSERT_TRUE(written.diagnostics.empty()) << base::to_string(written.diagnostics.front());
    const ModelResult read = parse_model(written.text, "m.yaml", options);
    ASSERT_TRUE(read.model.has_value()) << written.text;
    ASSERT_FALSE(base::has_errors(read.diagnostics)) << base::to_string(read.diagnostics.front()) << written.text;
    const scene::Model& m = *read.model;
    EXPECT_EQ(m.ignore_inter_collision, model.ignore_inter_collision);
    EXPECT_EQ(m.gravity, model.gravity);
    EXPECT_EQ(m.joint_erp, model.joint_erp);
    EXPECT_EQ(m.joint_cfm, model.joint_cfm);
    expect_all(model.bodies, m.bodies, seed);
    expect_all(model.joints, m.joints, seed);
    expect_all(model.cameras, m.cameras, seed);
    expect_all(model.lights, m.lights, seed);
    expect_all(model.blocks, m.blocks, seed);
    if (testing::Test::HasFailure()) {
      FAIL() << "seed " << seed << "\n" << written.text;
    }
  }
}

TEST(Write, TheHeaderListsComeFirstAndDefaultsAreLeftOut) {
  scene::Model model;
  scene::Body body;
  body.identity.identifier = "BODY a";
  body.identity.name = "a";
  body.identity.name_space = "/t/";
  model.bodies.push_back(body);
  EXPECT_EQ(write_model(model).text,
            "adf version: 1.0\nnamespace: /t/\nbodies:\n  - BODY a\n\nBODY a:\n  name: a\n  mass: 1\n");
}

TEST(Write, WhatNoKeySaysIsNamed) {
  scene::Model model;
  scene::Body body;
  body.identity.identifier = body.identity.name = "a";
  body.visual.material.emplace();
  body.visual.material->ambient = {0.9, 0.1, 0.2};
  model.bodies.push_back(body);
  const WrittenModel written = write_model(model);
  ASSERT_EQ(written.diagnostics.size(), 1u);
  EXPECT_NE(written.diagnostics.front().message.find("ambient"), std::string::npos);
}

}  // namespace
}  // namespace ambf::adf
