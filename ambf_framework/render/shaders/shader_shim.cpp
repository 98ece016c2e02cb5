#include "render/shaders/detail/shader_shim.h"

#include <cctype>
#include <cstdlib>
#include <map>
#include <set>

namespace ambf::render {

namespace {

// What both stages may read of the fixed-function state.
constexpr const char* kState = R"(
uniform mat4 ambf_ModelViewMatrix, ambf_ProjectionMatrix, ambf_ModelViewProjectionMatrix, ambf_TextureMatrix[8];
uniform mat3 ambf_NormalMatrix;
struct ambf_Material { vec4 emission, ambient, diffuse, specular; float shininess; };
uniform ambf_Material ambf_FrontMaterial;
struct ambf_Light {
  vec4 ambient, diffuse, specular, position, halfVector;
  vec3 spotDirection;
  float spotExponent, spotCutoff, spotCosCutoff, constantAttenuation, linearAttenuation, quadraticAttenuation;
};
uniform ambf_Light ambf_LightSource[8];
struct ambf_LightModelParameters { vec4 ambient; };
uniform ambf_LightModelParameters ambf_LightModel;
struct ambf_FogParameters { vec4 color; float density, start, end, scale; };
uniform ambf_FogParameters ambf_Fog;
struct ambf_SceneColor { vec4 sceneColor; };
struct ambf_Product { vec4 ambient, diffuse, specular; };
ambf_SceneColor ambf_scene_color() {
  return ambf_SceneColor(ambf_FrontMaterial.emission + ambf_FrontMaterial.ambient * ambf_LightModel.ambient);
}
ambf_Product ambf_product(int i) {
  return ambf_Product(ambf_FrontMaterial.ambient * ambf_LightSource[i].ambient,
                      ambf_FrontMaterial.diffuse * ambf_LightSource[i].diffuse,
                      ambf_FrontMaterial.specular * ambf_LightSource[i].specular);
}
)";

// Functions and state that only changed their names.
const std::map<std::string, std::string>& renamed() {
  static const std::map<std::string, std::string> names = {
      {"texture1D", "texture"},
      {"texture2D", "texture"},
      {"texture3D", "texture"},
      {"textureCube", "texture"},
      {"texture2DLod", "textureLod"},
      {"textureCubeLod", "textureLod"},
      {"texture2DProj", "textureProj"},
      {"texture2DProjLod", "textureProjLod"},
      {"shadow2D", "ambf_shadow2D"},
      {"shadow2DProj", "ambf_shadow2DProj"},
      {"gl_ModelViewMatrix", "ambf_ModelViewMatrix"},
      {"gl_ProjectionMatrix", "ambf_ProjectionMatrix"},
      {"gl_ModelViewProjectionMatrix", "ambf_ModelViewProjectionMatrix"},
      {"gl_TextureMatrix", "ambf_TextureMatrix"},
      {"gl_NormalMatrix", "ambf_NormalMatrix"},
      {"gl_NormalScale", "1.0"},
      {"gl_ModelViewMatrixInverse", "inverse(ambf_ModelViewMatrix)"},
      {"gl_ProjectionMatrixInverse", "inverse(ambf_ProjectionMatrix)"},
      {"gl_ModelViewProjectionMatrixInverse", "inverse(ambf_ModelViewProjectionMatrix)"},
      {"gl_ModelViewMatrixTranspose", "transpose(ambf_ModelViewMatrix)"},
      {"gl_ProjectionMatrixTranspose", "transpose(ambf_ProjectionMatrix)"},
      {"gl_ModelViewProjectionMatrixTranspose", "transpose(ambf_ModelViewProjectionMatrix)"},
      {"gl_ModelViewMatrixInverseTranspose", "transpose(inverse(ambf_ModelViewMatrix))"},
      {"gl_FrontMaterial", "ambf_FrontMaterial"},
      {"gl_BackMaterial", "ambf_FrontMaterial"},
      {"gl_LightSource", "ambf_LightSource"},
      {"gl_LightModel", "ambf_LightModel"},
      {"gl_Fog", "ambf_Fog"},
      {"gl_FrontLightModelProduct", "ambf_scene_color()"},
      {"gl_BackLightModelProduct", "ambf_scene_color()"},
      {"gl_MaxLights", "8"},
      {"gl_MaxTextureUnits", "8"},
      {"gl_MaxTextureCoords", "8"},
      {"gl_ClipVertex", "ambf_ClipVertex"},
      {"gl_TexCoord", "ambf_TexCoord"},
      {"gl_FogFragCoord", "ambf_FogFragCoord"},
      {"gl_FragColor", "ambf_FragColor"},
      {"gl_FragData", "ambf_FragData"},
  };
  return names;
}

// Words that older versions leave to the user.
const std::set<std::string>& words_since_130() {
  static const std::set<std::string> words = {"flat", "smooth", "noperspective", "layout", "switch", "case",
                                              "uint", "uvec2",  "uvec3",         "uvec4",  "sample"};
  return words;
}

bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

struct Attribute {
  const char* theirs;
  const char* ours;
};
// By place, as in gpu_store.h; 3 to 6 are the instances' and unused here.
constexpr std::array<Attribute, 10> kAttributes = {{{"aPosition", "ambf_position"},
                                                    {"aNormal", "ambf_normal"},
                                                    {"aTexCoord", "ambf_texcoord"},
                                                    {"row0", "row0"},
                                                    {"row1", "row1"},
                                                    {"row2", "row2"},
                                                    {"tint", "tint"},
                                                    {"aTangent", "ambf_tangent"},
                                                    {"aBitangent", "ambf_bitangent"},
                                                    {"aColor", "ambf_color"}}};

// One file, word by word.
class Translation {
 public:
  Translation(const std::string& source, bool is_vertex) : source_(source), is_vertex_(is_vertex) {
    for (std::size_t at = 0; at < source_.size();) at = scan(at, nullptr);
  }
  bool has(const std::string& word) const { return words_.count(word) != 0; }
  std::string translated() {
    std::string out;
    for (std::size_t at = 0; at < source_.size();) at = scan(at, &out);
    return out;
  }

 private:
  // Handles what begins at `at`; returns where it ends.
  std::size_t scan(std::size_t at, std::string* out) {
    std::size_t end = at + 1;
    if (source_.compare(at, 2, "//") == 0) {
      end = std::min(source_.find('\n', at), source_.size());
    } else if (source_.compare(at, 2, "/*") == 0) {
      end = source_.find("*/", at);
      end = end == std::string::npos ? source_.size() : end + 2;
    } else if (source_[at] == '#' && is_directive(at, "version")) {
      version_ = std::atoi(source_.c_str() + source_.find("version", at) + 7);
      return std::min(source_.find('\n', at), source_.size());
    } else if (source_[at] == '#' &&
               is_directive(at, "extension")) {  // only allowed before everything else, ours included
      return std::min(source_.find('\n', at), source_.size());
    } else if (starts_word(source_[at])) {
      while (end < source_.size() && in_word(source_[end])) ++end;
      const std::string word = source_.substr(at, end - at);
      words_.insert(word);
      if (out != nullptr) *out += word_for(word, end);
      return end;
    } else if (std::isdigit(static_cast<unsigned char>(source_[at])) != 0) {
      while (end < source_.size() && (in_word(source_[end]) || source_[end] == '.')) ++end;
    }
    if (out != nullptr) out->append(source_, at, end - at);
    return end;
  }

  bool is_directive(std::size_t at, const char* name) const {
    std::size_t begin = at + 1;
    while (begin < source_.size() && (source_[begin] == ' ' || source_[begin] == '\t')) ++begin;
    return source_.compare(begin, std::string(name).size(), name) == 0;
  }
  char next_sign(std::size_t end) const {
    while (end < source_.size() && std::isspace(static_cast<unsigned char>(source_[end])) != 0) ++end;
    return end < source_.size() ? source_[end] : '\0';
  }
  std::string attribute(std::size_t place) const {
    return has(kAttributes[place].theirs) ? kAttributes[place].theirs : kAttributes[place].ours;
  }

  std::string word_for(const std::string& word, std::size_t end) const {
    if (word == "attribute") return "in";
    if (word == "varying") return is_vertex_ ? "out" : "in";
    if (is_vertex_) {
      if (word == "gl_Vertex") return "vec4(vec3(" + attribute(0) + "), 1.0)";
      if (word == "gl_Normal") return "vec3(" + attribute(1) + ")";
      if (word.rfind("gl_MultiTexCoord", 0) == 0) return "vec4(vec2(" + attribute(2) + "), 0.0, 1.0)";
      if (word == "gl_Color") return "vec4(" + attribute(9) + ")";
      if (word == "ftransform") return "ambf_ftransform";
      if (word == "gl_FrontColor") return "ambf_FrontColor";
      if (word == "gl_BackColor") return "ambf_BackColor";
    } else if (word == "gl_Color") {
      return "ambf_FrontColor";
    } else if (word == "main") {
      return "ambf_their_main";
    }
    if (word == "gl_FrontLightProduct" || word == "gl_BackLightProduct") return "ambf_PRODUCT";
    if (const auto found = renamed().find(word); found != renamed().end()) return found->second;
    // A variable of this name, which was free, hides the function that we rename others to.
    if (word == "texture" && next_sign(end) != '(') return "ambf_their_texture";
    if (version_ < 130 && words_since_130().count(word) != 0) return "ambf_their_" + word;
    return word;
  }

  const std::string& source_;
  const bool is_vertex_;
  int version_ = 110;
  std::set<std::string> words_;
};

// Where transparent surfaces are peeled (scene_renderer.cpp), what lies before the layer or behind solid things is left out first.
constexpr const char* kMain = R"(
uniform bool ambf_Peeled;
uniform sampler2D ambf_NearerDepth, ambf_OpaqueDepth;
void main() {
  if (ambf_Peeled) {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (gl_FragCoord.z <= texelFetch(ambf_NearerDepth, pixel, 0).r + 1e-7 ||
        gl_FragCoord.z > texelFetch(ambf_OpaqueDepth, pixel, 0).r) discard;
  }
  ambf_their_main();
}
)";

// name[index] cannot call a function, name(index) can.
std::string with_products(std::string text) {
  constexpr const char* kMark = "ambf_PRODUCT";
  for (std::size_t at = text.find(kMark); at != std::string::npos; at = text.find(kMark, at)) {
    const std::size_t open = text.find('[', at), close = text.find(']', at);
    if (open == std::string::npos || close == std::string::npos) return text;
    text =
        text.substr(0, at) + "ambf_product(" + text.substr(open + 1, close - open - 1) + ")" + text.substr(close + 1);
  }
  return text;
}

}  // namespace

ShimmedShaders shim(const std::string& vertex, const std::string& fragment) {
  Translation v(vertex, true), f(fragment, false);
  ShimmedShaders out;
  const std::string begin = std::string("#version 330 core\n") + kState +
                            "vec4 ambf_shadow2D(sampler2DShadow s, vec3 c) { return vec4(texture(s, c)); }\n"
                            "vec4 ambf_shadow2DProj(sampler2DShadow s, vec4 c) { return vec4(textureProj(s, c)); }\n";
  std::string to_fragment, from_vertex;
  const auto passed = [&](bool wanted, const std::string& declaration) {
    if (!wanted) return;
    to_fragment += "out " + declaration + ";\n";
    from_vertex += "in " + declaration + ";\n";
  };
  passed(v.has("gl_TexCoord") || f.has("gl_TexCoord"), "vec4 ambf_TexCoord[8]");
  passed(v.has("gl_FogFragCoord") || f.has("gl_FogFragCoord"), "float ambf_FogFragCoord");
  passed(v.has("gl_FrontColor") || f.has("gl_Color"), "vec4 ambf_FrontColor");

  std::string inputs;
  for (std::size_t place = 0; place < kAttributes.size(); ++place) {
    const bool own = v.has(kAttributes[place].theirs);
    out.attributes[place] = own ? kAttributes[place].theirs : kAttributes[place].ours;
    if (!own && (place < 3 || place == 9)) inputs += std::string("in vec4 ") + kAttributes[place].ours + ";\n";
  }
  out.wants_tangents = v.has("aTangent") || v.has("aBitangent");
  // Their own declaration comes later than ours: a function declared here, defined at the end, sees it.
  out.vertex =
      begin + inputs + to_fragment + "vec4 ambf_ClipVertex, ambf_BackColor;\nvec4 ambf_ftransform();\n#line 1\n" +
      with_products(v.translated()) + "\nvec4 ambf_ftransform() { return ambf_ModelViewProjectionMatrix * vec4(vec3(" +
      out.attributes[0] + "), 1.0); }\n";
  std::string outputs;
  if (f.has("gl_FragColor")) outputs += "out vec4 ambf_FragColor;\n";
  if (f.has("gl_FragData")) outputs += "out vec4 ambf_FragData[1];\n";
  out.fragment =
      begin + from_vertex + outputs + "#line 1\n" + with_products(f.translated()) + (f.has("main") ? kMain : "");
  return out;
}

}  // namespace ambf::render
