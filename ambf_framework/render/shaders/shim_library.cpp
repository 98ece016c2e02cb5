#include "render/shaders/detail/shim_library.h"

#include <map>
#include <set>

namespace ambf::render {

// Initial values are those of the compatibility profile. In ambf_EyePlane*[1] the renderer puts the planes of the
// shadow map (scene/fixed_function.h).
const char* const kShimDeclarations = R"(
uniform mat4 ambf_ModelViewMatrix, ambf_ProjectionMatrix, ambf_ModelViewProjectionMatrix;
uniform mat4 ambf_TextureMatrix[8] = mat4[8](mat4(1.0), mat4(1.0), mat4(1.0), mat4(1.0),
                                             mat4(1.0), mat4(1.0), mat4(1.0), mat4(1.0));
uniform mat3 ambf_NormalMatrix;
#define AMBF_ALL(v) vec4[8](v, v, v, v, v, v, v, v)
const vec4 ambf_along_x = vec4(1.0, 0.0, 0.0, 0.0), ambf_along_y = vec4(0.0, 1.0, 0.0, 0.0);
uniform vec4 ambf_EyePlaneS[8] = AMBF_ALL(ambf_along_x), ambf_EyePlaneT[8] = AMBF_ALL(ambf_along_y),
             ambf_EyePlaneR[8] = AMBF_ALL(vec4(0.0)), ambf_EyePlaneQ[8] = AMBF_ALL(vec4(0.0));
uniform vec4 ambf_ObjectPlaneS[8] = AMBF_ALL(ambf_along_x), ambf_ObjectPlaneT[8] = AMBF_ALL(ambf_along_y),
             ambf_ObjectPlaneR[8] = AMBF_ALL(vec4(0.0)), ambf_ObjectPlaneQ[8] = AMBF_ALL(vec4(0.0));
uniform vec4 ambf_ClipPlane[8] = AMBF_ALL(vec4(0.0)), ambf_TextureEnvColor[8] = AMBF_ALL(vec4(0.0));
struct ambf_Material { vec4 emission, ambient, diffuse, specular; float shininess; };
uniform ambf_Material ambf_FrontMaterial;
struct ambf_Light {
  vec4 ambient, diffuse, specular, position, halfVector;
  vec3 spotDirection;
  float spotExponent, spotCutoff, spotCosCutoff, constantAttenuation, linearAttenuation, quadraticAttenuation;
};
uniform ambf_Light ambf_LightSource[8];
struct ambf_LightModelParameters { vec4 ambient; };
uniform ambf_LightModelParameters ambf_LightModel = ambf_LightModelParameters(vec4(0.2, 0.2, 0.2, 1.0));
struct ambf_FogParameters { vec4 color; float density, start, end, scale; };
uniform ambf_FogParameters ambf_Fog = ambf_FogParameters(vec4(0.0), 1.0, 0.0, 1.0, 1.0);
struct ambf_PointParameters {
  float size, sizeMin, sizeMax, fadeThresholdSize;
  float distanceConstantAttenuation, distanceLinearAttenuation, distanceQuadraticAttenuation;
};
uniform ambf_PointParameters ambf_Point = ambf_PointParameters(1.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0);
struct ambf_SceneColor { vec4 sceneColor; };
struct ambf_Product { vec4 ambient, diffuse, specular; };
ambf_SceneColor ambf_scene_color() {
  return ambf_SceneColor(ambf_FrontMaterial.emission + ambf_FrontMaterial.ambient * ambf_LightModel.ambient);
}
float ambf_light_level = 1.0;
ambf_Product ambf_product(int i) {
  vec4 level = vec4(vec3(ambf_light_level), 1.0);
  return ambf_Product(ambf_FrontMaterial.ambient * ambf_LightSource[i].ambient * level,
                      ambf_FrontMaterial.diffuse * ambf_LightSource[i].diffuse * level,
                      ambf_FrontMaterial.specular * ambf_LightSource[i].specular * level);
}
// Of a plane with a position; files pass positions of three components, too.
float ambf_plane_dot(vec4 plane, vec4 position) { return dot(plane, position); }
float ambf_plane_dot(vec4 plane, vec3 position) { return dot(plane, vec4(position, 1.0)); }
// Outside the light's part of the shadow map, and behind the light, nothing is known to be in shadow.
uniform vec4 ambf_ShadowTile = vec4(0.0, 0.0, 1.0, 1.0);  // min u, v, max u, v
vec4 ambf_shadow1D(sampler1DShadow s, vec3 c) { return vec4(texture(s, c)); }
vec4 ambf_shadow1DProj(sampler1DShadow s, vec4 c) { return vec4(textureProj(s, c)); }
vec4 ambf_shadow2D(sampler2DShadow s, vec3 c) {
  bool outside = any(lessThan(c.xy, ambf_ShadowTile.xy)) || any(greaterThan(c.xy, ambf_ShadowTile.zw));
  return vec4(outside || c.z >= 1.0 ? 1.0 : texture(s, c));
}
vec4 ambf_shadow2DProj(sampler2DShadow s, vec4 c) { return c.w <= 0.0 ? vec4(1.0) : ambf_shadow2D(s, c.xyz / c.w); }
)";

// Where transparent surfaces are peeled (scene_renderer.cpp), fragments before the layer or behind opaque surfaces
// are discarded.
#define AMBF_SHIM_PEEL                                                           \
  "uniform bool ambf_Peeled;\n"                                                  \
  "uniform sampler2D ambf_NearerDepth, ambf_OpaqueDepth;\n"                      \
  "void ambf_peel() {\n"                                                         \
  "  if (!ambf_Peeled) return;\n"                                                \
  "  ivec2 pixel = ivec2(gl_FragCoord.xy);\n"                                    \
  "  if (gl_FragCoord.z <= texelFetch(ambf_NearerDepth, pixel, 0).r + 1e-7 ||\n" \
  "      gl_FragCoord.z > texelFetch(ambf_OpaqueDepth, pixel, 0).r) discard;\n"  \
  "}\n"

const char* const kShimMain = "\n" AMBF_SHIM_PEEL "void main() { ambf_peel(); ambf_their_main(); }\n";

// The original draws opaque things twice: with its lights dimmed, then lit, where an alpha test drops what lies in
// shadow. So alpha below 0.99 asks for the dimmed colour.
const char* const kShimShadowMain = "\n" AMBF_SHIM_PEEL R"(uniform bool ambf_AlphaIsShadow;
void main() {
  ambf_peel();
  ambf_their_main();
  if (!ambf_AlphaIsShadow) return;
  if (ambf_FragColor.a < 0.99) {
    ambf_light_level = 0.5;
    ambf_their_main();
  }
  ambf_FragColor.a = 1.0;
}
)";

#undef AMBF_SHIM_PEEL

const std::string* shim_replacement(const std::string& word) {
  static const std::map<std::string, std::string> names = {
      {"texture1D", "texture"},
      {"texture1DProj", "textureProj"},
      {"texture1DLod", "textureLod"},
      {"texture1DProjLod", "textureProjLod"},
      {"texture2D", "texture"},
      {"texture2DProj", "textureProj"},
      {"texture2DLod", "textureLod"},
      {"texture2DProjLod", "textureProjLod"},
      {"texture2DRect", "texture"},
      {"texture2DRectProj", "textureProj"},
      {"texture3D", "texture"},
      {"texture3DProj", "textureProj"},
      {"texture3DLod", "textureLod"},
      {"texture3DProjLod", "textureProjLod"},
      {"textureCube", "texture"},
      {"textureCubeLod", "textureLod"},
      {"shadow1D", "ambf_shadow1D"},
      {"shadow1DProj", "ambf_shadow1DProj"},
      {"shadow2D", "ambf_shadow2D"},
      {"shadow2DProj", "ambf_shadow2DProj"},
      {"gl_ModelViewMatrix", "ambf_ModelViewMatrix"},
      {"gl_ProjectionMatrix", "ambf_ProjectionMatrix"},
      {"gl_ModelViewProjectionMatrix", "ambf_ModelViewProjectionMatrix"},
      {"gl_NormalMatrix", "ambf_NormalMatrix"},
      {"gl_NormalScale", "1.0"},
      {"gl_ModelViewMatrixInverse", "inverse(ambf_ModelViewMatrix)"},
      {"gl_ProjectionMatrixInverse", "inverse(ambf_ProjectionMatrix)"},
      {"gl_ModelViewProjectionMatrixInverse", "inverse(ambf_ModelViewProjectionMatrix)"},
      {"gl_ModelViewMatrixTranspose", "transpose(ambf_ModelViewMatrix)"},
      {"gl_ProjectionMatrixTranspose", "transpose(ambf_ProjectionMatrix)"},
      {"gl_ModelViewProjectionMatrixTranspose", "transpose(ambf_ModelViewProjectionMatrix)"},
      {"gl_ModelViewMatrixInverseTranspose", "transpose(inverse(ambf_ModelViewMatrix))"},
      {"gl_ProjectionMatrixInverseTranspose", "transpose(inverse(ambf_ProjectionMatrix))"},
      {"gl_ModelViewProjectionMatrixInverseTranspose", "transpose(inverse(ambf_ModelViewProjectionMatrix))"},
      // Identities, as are their inverses and transposes.
      {"gl_TextureMatrix", "ambf_TextureMatrix"},
      {"gl_TextureMatrixInverse", "ambf_TextureMatrix"},
      {"gl_TextureMatrixTranspose", "ambf_TextureMatrix"},
      {"gl_TextureMatrixInverseTranspose", "ambf_TextureMatrix"},
      {"gl_EyePlaneS", "ambf_EyePlaneS"},
      {"gl_EyePlaneT", "ambf_EyePlaneT"},
      {"gl_EyePlaneR", "ambf_EyePlaneR"},
      {"gl_EyePlaneQ", "ambf_EyePlaneQ"},
      {"gl_ObjectPlaneS", "ambf_ObjectPlaneS"},
      {"gl_ObjectPlaneT", "ambf_ObjectPlaneT"},
      {"gl_ObjectPlaneR", "ambf_ObjectPlaneR"},
      {"gl_ObjectPlaneQ", "ambf_ObjectPlaneQ"},
      {"gl_ClipPlane", "ambf_ClipPlane"},
      {"gl_TextureEnvColor", "ambf_TextureEnvColor"},
      {"gl_Point", "ambf_Point"},
      {"gl_FrontMaterial", "ambf_FrontMaterial"},
      {"gl_BackMaterial", "ambf_FrontMaterial"},
      {"gl_LightSource", "ambf_LightSource"},
      {"gl_LightModel", "ambf_LightModel"},
      {"gl_Fog", "ambf_Fog"},
      {"gl_FrontLightModelProduct", "ambf_scene_color()"},
      {"gl_BackLightModelProduct", "ambf_scene_color()"},
      {"gl_MaxLights", "8"},
      {"gl_MaxClipPlanes", "8"},
      {"gl_MaxTextureUnits", "8"},
      {"gl_MaxTextureCoords", "8"},
      {"gl_ClipVertex", "ambf_ClipVertex"},
      {"gl_TexCoord", "ambf_TexCoord"},
      {"gl_FogFragCoord", "ambf_FogFragCoord"},
      {"gl_FragColor", "ambf_FragColor"},
      {"gl_FragData", "ambf_FragData"},
  };
  const auto found = names.find(word);
  return found == names.end() ? nullptr : &found->second;
}

bool keyword_since_130(const std::string& word) {
  static const std::set<std::string> words = {"flat", "smooth", "noperspective", "layout", "switch", "case",
                                              "uint", "uvec2",  "uvec3",         "uvec4",  "sample"};
  return words.count(word) != 0;
}

}  // namespace ambf::render
