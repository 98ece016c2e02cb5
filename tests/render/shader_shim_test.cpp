#include "render/shaders/detail/shader_shim.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ambf::render {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// What comes after the "#line 1" that our own lines end with.
std::string own_lines(const std::string& text) { return text.substr(text.find("#line 1\n") + 8); }

TEST(ShaderShim, OldWordsBecomeNewOnesAndCommentsStay) {
  const ShimmedShaders made =
      shim("#version 120\nattribute vec3 aPosition; // attribute\nvarying vec2 uv;\n",
           "#version 120\nvarying vec2 uv;\nvoid main() { gl_FragColor = texture2D(t, uv); /* texture2D */ }\n");
  EXPECT_EQ(own_lines(made.vertex).substr(0, 66),
            "\nin vec3 aPosition; // attribute\nout vec2 uv;\n\nvec4 ambf_ftransfor");
  const std::string expected =
      "\nin vec2 uv;\nvoid ambf_their_main() { ambf_FragColor = texture(t, uv); /* texture2D */ }\n";
  EXPECT_EQ(own_lines(made.fragment).substr(0, expected.size()), expected);
  EXPECT_TRUE(has(made.fragment, "out vec4 ambf_FragColor;"));
}

TEST(ShaderShim, LinesStayWhereTheyAreInTheFile) {
  const std::string source =
      "// first\n#version 130\n#extension GL_ARB_texture_rectangle : enable\n/* two\nlines */\nvoid main() {}\n";
  const std::string lines = own_lines(shim(source, source).fragment);
  const auto their_main = lines.begin() + static_cast<std::ptrdiff_t>(lines.find("void ambf_their_main"));
  EXPECT_EQ(std::count(lines.begin(), their_main, '\n'), 5);
  EXPECT_FALSE(has(lines, "#version"));
  EXPECT_FALSE(has(lines, "#extension"));
}

TEST(ShaderShim, TheFilesOwnAttributesTakeThePlaceOfOurs) {
  const ShimmedShaders theirs =
      shim("attribute vec3 aPosition;\nvoid main() { gl_Position = ftransform(); }", "void main() {}");
  EXPECT_EQ(theirs.attributes[0], "aPosition");
  EXPECT_TRUE(has(theirs.vertex, "vec4(vec3(aPosition), 1.0); }"));
  EXPECT_FALSE(has(theirs.vertex, "in vec4 ambf_position"));
  const ShimmedShaders ours =
      shim("void main() { gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; }", "void main() {}");
  EXPECT_EQ(ours.attributes[0], "ambf_position");
  EXPECT_TRUE(has(ours.vertex, "ambf_ModelViewProjectionMatrix * vec4(vec3(ambf_position), 1.0)"));
  EXPECT_FALSE(ours.wants_tangents);
  EXPECT_TRUE(shim("attribute vec3 aTangent;", "").wants_tangents);
}

TEST(ShaderShim, AVariableNamedAsAFunctionOfToday) {
  const std::string made = own_lines(
      shim("", "uniform sampler2D texture;\nvoid main() { gl_FragColor = texture2D(texture, vec2(0.0)); }").fragment);
  EXPECT_TRUE(has(made, "uniform sampler2D ambf_their_texture;"));
  EXPECT_TRUE(has(made, "texture(ambf_their_texture, vec2(0.0))"));
  EXPECT_TRUE(has(shim("", "#version 120\nfloat smooth = 1.0;").fragment, "float ambf_their_smooth"));
  EXPECT_TRUE(has(shim("", "#version 130\nsmooth in vec3 n;").fragment, "smooth in vec3 n;"));
}

TEST(ShaderShim, BuiltInVaryingsAreDeclaredOnBothSides) {
  const ShimmedShaders made =
      shim("void main() { gl_TexCoord[0] = gl_MultiTexCoord0; }", "void main() { gl_FragColor = gl_TexCoord[0]; }");
  EXPECT_TRUE(has(made.vertex, "out vec4 ambf_TexCoord[1];"));
  EXPECT_TRUE(has(made.fragment, "in vec4 ambf_TexCoord[1];"));
}

TEST(ShaderShim, BuiltInArraysAreAsLongAsTheirLastIndex) {
  EXPECT_TRUE(has(shim("void main() { gl_TexCoord [ 2 ] = gl_TexCoord[0]; }", "").vertex, "vec4 ambf_TexCoord[3];"));
  EXPECT_TRUE(has(shim("", "void main() { x = gl_TexCoord[i]; }").fragment, "vec4 ambf_TexCoord[8];"));
  EXPECT_TRUE(has(shim("", "void main() { x = gl_TexCoord[99]; }").fragment, "vec4 ambf_TexCoord[8];"));
  EXPECT_TRUE(has(shim("", "void main() { gl_FragData[1] = x; }").fragment, "out vec4 ambf_FragData[2];"));
}

TEST(ShaderShim, DotProductsWithPlanesTakePositionsOfThreeComponents) {
  const std::string made = own_lines(shim("void main() { a = dot( gl_EyePlaneS[1], p) + dot(n, l); }", "").vertex);
  EXPECT_TRUE(has(made, "ambf_plane_dot( ambf_EyePlaneS[1], p) + dot(n, l)"));
}

TEST(ShaderShim, LightProductsTakeAnyIndex) {
  const std::string made = own_lines(shim("", "vec4 a = gl_FrontLightProduct[of[i]].ambient;").fragment);
  EXPECT_TRUE(has(made, "ambf_product(of[i]).ambient"));
}

TEST(ShaderShim, AnyBytesEnd) {
  for (const char* text :
       {"", "/*", "//", "#", "#version", "gl_FrontLightProduct", "gl_FrontLightProduct[", "gl_FrontLightProduct[[",
        "gl_TexCoord", "gl_TexCoord[", "gl_TexCoord[1", "dot(", "\\", "\"", "0x", "é"}) {
    const ShimmedShaders made = shim(text, text);
    EXPECT_FALSE(made.vertex.empty());
  }
}

}  // namespace
}  // namespace ambf::render
