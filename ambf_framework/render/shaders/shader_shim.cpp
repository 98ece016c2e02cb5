#include "render/shaders/detail/shader_shim.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>

#include "render/shaders/detail/shim_library.h"

namespace ambf::render {

namespace {

bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

struct Attribute {
  const char* theirs;
  const char* ours;
};
// Marks gl_FrontLightProduct and gl_BackLightProduct until with_products().
constexpr const char* kProductMark = "ambf_PRODUCT";

// By place, as in gpu_store.h; 3 to 6 are the instances' and unused here.
constexpr std::array<Attribute, 10> kAttributes = {{{"aPosition", "ambf_position"},
                                                    {"aNormal", "ambf_normal"},
                                                    {"aTexCoord", "ambf_texcoord"},
                                                    {"row0", "row0"},
                                                    {"row1", "row1"},
                                                    {"row2", "row2"},
                                                    {"body", "body"},
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
  std::size_t skip_spaces(std::size_t at) const {
    while (at < source_.size() && std::isspace(static_cast<unsigned char>(source_[at])) != 0) ++at;
    return at;
  }
  char next_sign(std::size_t end) const {
    const std::size_t at = skip_spaces(end);
    return at < source_.size() ? source_[at] : '\0';
  }
  // Is the first argument of the call that follows one of gl_EyePlaneS ... gl_ObjectPlaneQ?
  bool begins_with_plane(std::size_t end) const {
    if (next_sign(end) != '(') return false;
    const std::size_t at = skip_spaces(skip_spaces(end) + 1);
    return source_.compare(at, 11, "gl_EyePlane") == 0 || source_.compare(at, 14, "gl_ObjectPlane") == 0;
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
      if (word == "gl_SecondaryColor") return "vec4(0.0, 0.0, 0.0, 1.0)";
      if (word == "gl_FogCoord") return "0.0";
      if (word == "ftransform") return "ambf_ftransform";
      if (word == "gl_FrontColor") return "ambf_FrontColor";
      if (word == "gl_FrontSecondaryColor") return "ambf_FrontSecondaryColor";
      if (word == "gl_BackColor" || word == "gl_BackSecondaryColor") return "ambf_BackColor";
    } else if (word == "gl_Color") {
      return "ambf_FrontColor";
    } else if (word == "gl_SecondaryColor") {
      return "ambf_FrontSecondaryColor";
    } else if (word == "main") {
      return "ambf_their_main";
    }
    if (word == "gl_FrontLightProduct" || word == "gl_BackLightProduct") return kProductMark;
    if (word == "dot" && begins_with_plane(end)) return "ambf_plane_dot";
    if (const std::string* replacement = shim_replacement(word)) return *replacement;
    // A variable of this name, which was free, hides the function that we rename others to.
    if (word == "texture" && next_sign(end) != '(') return "ambf_their_texture";
    if (version_ < 130 && keyword_since_130(word)) return "ambf_their_" + word;
    return word;
  }

  const std::string& source_;
  const bool is_vertex_;
  int version_ = 110;
  std::set<std::string> words_;
};

// name[index] cannot call a function, name(index) can.
std::string with_products(std::string text) {
  for (std::size_t at = text.find(kProductMark); at != std::string::npos; at = text.find(kProductMark, at)) {
    const std::size_t open = text.find('[', at);
    if (open == std::string::npos) return text;
    std::size_t close = open + 1;
    for (int depth = 1; close < text.size(); ++close) {
      if (text[close] == '[') ++depth;
      if (text[close] == ']' && --depth == 0) break;
    }
    if (close == text.size()) return text;
    text =
        text.substr(0, at) + "ambf_product(" + text.substr(open + 1, close - open - 1) + ")" + text.substr(close + 1);
  }
  return text;
}

// How long the built-in array must be for all literal indices in `source`; `longest` when an index is computed. 0:
// not used.
int array_length(const std::string& source, const std::string& array, int longest) {
  int length = 0;
  for (std::size_t at = source.find(array); at != std::string::npos; at = source.find(array, at + 1)) {
    const std::size_t open = source.find_first_not_of(" \t", at + array.size());
    if (open == std::string::npos || source[open] != '[') return longest;
    const std::size_t first = source.find_first_not_of(" \t", open + 1);
    const std::size_t last = source.find_first_not_of("0123456789", first);
    const std::size_t close = source.find_first_not_of(" \t", last);
    if (close == std::string::npos || last == first || source[close] != ']') return longest;
    length = std::clamp(std::atoi(source.c_str() + first) + 1, length, longest);
  }
  return length;
}

}  // namespace

ShimmedShaders shim(const std::string& vertex, const std::string& fragment) {
  Translation v(vertex, true), f(fragment, false);
  ShimmedShaders out;
  const std::string begin = std::string("#version 330 core\n") + kShimDeclarations;
  std::string to_fragment, from_vertex;
  const auto passed = [&](bool wanted, const std::string& declaration) {
    if (!wanted) return;
    to_fragment += "out " + declaration + ";\n";
    from_vertex += "in " + declaration + ";\n";
  };
  // As short as possible: what passes between the stages is limited, and files pass arrays of their own.
  const int texcoords = std::max(array_length(vertex, "gl_TexCoord", 8), array_length(fragment, "gl_TexCoord", 8));
  passed(texcoords > 0, "vec4 ambf_TexCoord[" + std::to_string(texcoords) + "]");
  passed(v.has("gl_FogFragCoord") || f.has("gl_FogFragCoord"), "float ambf_FogFragCoord");
  passed(v.has("gl_FrontColor") || f.has("gl_Color"), "vec4 ambf_FrontColor");
  passed(v.has("gl_FrontSecondaryColor") || f.has("gl_SecondaryColor"), "vec4 ambf_FrontSecondaryColor");

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
  if (f.has("gl_FragData")) {
    outputs += "out vec4 ambf_FragData[" + std::to_string(array_length(fragment, "gl_FragData", 8)) + "];\n";
  }
  const bool shadowed = f.has("gl_FragColor") && (f.has("shadow2D") || f.has("shadow2DProj"));
  const char* main = !f.has("main") ? "" : shadowed ? kShimShadowMain : kShimMain;
  out.fragment = begin + from_vertex + outputs + "#line 1\n" + with_products(f.translated()) + main;
  return out;
}

}  // namespace ambf::render
