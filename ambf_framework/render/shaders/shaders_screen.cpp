// The shaders of what covers the whole picture, and of flat marks.
#include "render/shaders/detail/shader_parts.h"
#include "render/shaders/shaders.h"

namespace ambf::render {

namespace {

constexpr const char* kBackgroundVertex = R"(
in vec3 position;
uniform vec3 ahead, aside, above;  // of the view, world; aside and above scaled to the picture's edges
out vec3 ray;
void main() {
  ray = ahead + position.x * aside + position.y * above;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}
)";

constexpr const char* kGradientFragment = R"(
in vec3 ray;
out vec4 color;
void main() { color = vec4(sky(normalize(ray).z), 1.0); }
)";

// The front picture is seen along -x (ahead of a camera that looks as the default one does), right along +y, top
// along +z.
constexpr const char* kSkyboxFragment = R"(
in vec3 ray;
uniform samplerCube sky_texture;
out vec4 color;
void main() { color = vec4(srgb(texture(sky_texture, vec3(ray.y, ray.z, -ray.x)).rgb), 1.0); }
)";

constexpr const char* kScreenVertex = R"(
in vec3 position;
out vec2 uv;
void main() {
  uv = 0.5 + 0.5 * position.xy;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}
)";

// Samples in a disc around each point, as wide on the picture as `radius_m` is there. A sample hides as much of the
// surroundings as it stands above the surface, less so the further away it is.
constexpr const char* kOcclusionFragment = R"(
in vec2 uv;
uniform sampler2D depth;
uniform vec4 lens;         // near, far, half the picture's width and height at distance 1 (or, parallel, in m)
uniform vec3 middle;       // what is seen there, right and up; how much further right at the upper edge
uniform float parallel;    // 1: orthographic
uniform float radius_m;
out vec4 color;
float distance_m(vec2 at) {
  float z = texture(depth, at).r;
  return parallel > 0.5 ? mix(lens.x, lens.y, z) : lens.x * lens.y / (lens.y - z * (lens.y - lens.x));
}
vec3 seen(vec2 where) {
  // Of the pixel's middle: half a pixel beside it, a plane would not be one.
  vec2 size = vec2(textureSize(depth, 0)), at = (floor(where * size) + 0.5) / size;
  float m = distance_m(at);
  vec2 place = 2.0 * at - 1.0, aside = middle.xy + place * lens.zw + vec2(middle.z * place.y, 0.0);
  return vec3(aside * (parallel > 0.5 ? 1.0 : m), -m);
}
void main() {
  vec3 p = seen(uv);
  if (-p.z > 0.98 * lens.y) {
    color = vec4(1.0);
    return;
  }
  vec2 texel = 1.0 / vec2(textureSize(depth, 0));
  // The flatter side of each pair of neighbours, so that edges do not bend the normal.
  vec3 right = seen(uv + vec2(texel.x, 0.0)) - p, left = p - seen(uv - vec2(texel.x, 0.0));
  vec3 above = seen(uv + vec2(0.0, texel.y)) - p, below = p - seen(uv - vec2(0.0, texel.y));
  vec2 beyond = uv + 1.01 * texel;  // at the picture's upper and right edges there is no neighbour
  bool use_right = beyond.x < 1.0 && abs(right.z) < abs(left.z);
  bool use_above = beyond.y < 1.0 && abs(above.z) < abs(below.z);
  vec3 n = normalize(cross(use_right ? right : left, use_above ? above : below));
  vec2 reach = 0.5 * radius_m / (lens.zw * (parallel > 0.5 ? 1.0 : -p.z));
  reach = min(reach, vec2(0.12));
  // Sixteen turns, each once in every 4 x 4 texels (an ordered-dither matrix): averaged over as many, a plane is
  // even, without streaks.
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  int across = cell.x ^ cell.y;
  int place = ((across & 1) << 3) | ((cell.y & 1) << 2) | (across & 2) | ((cell.y & 2) >> 1);
  float turn = 6.2831853 * float(place) / 16.0;
  float hidden = 0.0;
  for (int i = 0; i < 12; ++i) {
    float r = (float(i) + 0.5) / 12.0, a = float(i) * 2.39996323 + turn;
    vec2 at = uv + reach * r * vec2(cos(a), sin(a));
    if (any(notEqual(at, clamp(at, 0.0, 1.0)))) continue;
    vec3 d = seen(at) - p;
    float square = dot(d, d), near = max(0.0, 1.0 - square / (radius_m * radius_m));
    hidden += max(0.0, dot(n, d) * inversesqrt(square + 1e-9) - 0.12) * near;
  }
  hidden *= 1.0 - smoothstep(0.5 * lens.y, 0.9 * lens.y, -p.z);  // as far things fade
  color = vec4(vec3(clamp(1.0 - 1.5 * hidden / 12.0, 0.0, 1.0)), 1.0);
}
)";

// 4 x 4 texels, the period of the turns above; those at other distances do not count.
constexpr const char* kOcclusionBlurFragment = R"(
in vec2 uv;
uniform sampler2D occlusion, depth;
uniform vec4 lens;
uniform float parallel;
out vec4 color;
float distance_m(vec2 at) {
  float z = texture(depth, at).r;
  return parallel > 0.5 ? mix(lens.x, lens.y, z) : lens.x * lens.y / (lens.y - z * (lens.y - lens.x));
}
void main() {
  vec2 texel = 1.0 / vec2(textureSize(occlusion, 0));
  float here_m = distance_m(uv), sum = 0.0, weights = 1e-4;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      vec2 at = uv + (vec2(float(x), float(y)) - 1.5) * texel;
      float weight = max(0.0, 1.0 - 40.0 * abs(distance_m(at) - here_m) / here_m) + 1e-4;
      sum += weight * texture(occlusion, at).r;
      weights += weight;
    }
  }
  color = vec4(vec3(sum / weights), 1.0);
}
)";

constexpr const char* kLayerFragment = R"(
in vec2 uv;
uniform sampler2D layer;
uniform float weighted;  // 1: colours are still to be multiplied by their alpha
out vec4 color;
void main() {
  color = texture(layer, uv);
  color.rgb *= mix(1.0, color.a, weighted);
}
)";

}  // namespace

std::string background_vertex_shader() { return std::string(kVersion) + kBackgroundVertex; }
std::string background_fragment_shader(bool sky) {
  return std::string(kVersion) + kDisplay + kSky + (sky ? kSkyboxFragment : kGradientFragment);
}
std::string screen_vertex_shader() { return std::string(kVersion) + kScreenVertex; }
std::string occlusion_fragment_shader() { return std::string(kVersion) + kOcclusionFragment; }
std::string occlusion_blur_fragment_shader() { return std::string(kVersion) + kOcclusionBlurFragment; }
std::string layer_fragment_shader() { return std::string(kVersion) + kLayerFragment; }

}  // namespace ambf::render
