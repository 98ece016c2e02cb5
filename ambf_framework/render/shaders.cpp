#include "render/shaders.h"

namespace ambf::render {

namespace {

constexpr const char* kVersion = "#version 330 core\n";

// Linear light -> display. The tone curve is Khronos' PBR Neutral: colours below 0.8 stay what they are, brighter ones roll off
// without changing hue.
constexpr const char* kDisplay = R"(
vec3 tone_mapped(vec3 color) {
  const float start = 0.8 - 0.04, desaturation = 0.15;
  float x = min(color.r, min(color.g, color.b));
  color -= x < 0.08 ? x - 6.25 * x * x : 0.04;
  float peak = max(color.r, max(color.g, color.b));
  if (peak < start) return color;
  float d = 1.0 - start;
  float new_peak = 1.0 - d * d / (peak + d - start);
  color *= new_peak / peak;
  return mix(color, vec3(new_peak), 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0));
}
// The sRGB curve within 0.3 % by square roots, which processors do several times faster than powers.
vec3 srgb(vec3 linear) {
  vec3 a = sqrt(linear), b = sqrt(a), c = sqrt(b);
  return max(0.662002687 * a + 0.684122060 * b - 0.323583601 * c - 0.0225411470 * linear, vec3(0.0));
}
)";

// A calm sky: light grey blue at the horizon, darker above and below. `up` is the sine of the elevation. Display values.
constexpr const char* kSky = R"(
vec3 sky(float up) {
  const vec3 horizon = vec3(0.80, 0.835, 0.87), zenith = vec3(0.47, 0.55, 0.65), nadir = vec3(0.52, 0.55, 0.58);
  return mix(horizon, up > 0.0 ? zenith : nadir, sqrt(abs(up)));
}
)";

constexpr const char* kPlace = R"(
in vec3 position;
in vec4 row0, row1, row2;
uniform mat4 world_to_clip;
vec3 in_world() {
  vec4 p = vec4(position, 1.0);
  return vec3(dot(row0, p), dot(row1, p), dot(row2, p));
}
)";

constexpr const char* kMeshVertex = R"(
in vec3 normal;
in vec2 texcoord;
in vec4 tint;
out vec3 point, direction;
out vec2 uv;
#if SHADOWS
uniform mat4 world_to_shadow;
uniform float shadow_offset_m;
out vec4 shadow_point;
#endif
flat out vec4 body_tint;
void main() {
  point = in_world();
  direction = normalize(vec3(dot(row0.xyz, normal), dot(row1.xyz, normal), dot(row2.xyz, normal)));
  uv = texcoord;
  body_tint = tint;
#if SHADOWS
  shadow_point = world_to_shadow * vec4(point + shadow_offset_m * direction, 1.0);
#endif
  gl_Position = world_to_clip * vec4(point, 1.0);
}
)";

constexpr const char* kMeshFragment = R"(
in vec3 point, direction;
in vec2 uv;
#if SHADOWS
in vec4 shadow_point;
#endif
flat in vec4 body_tint;
uniform vec3 eye;
uniform vec3 view_back;        // for orthographic pictures; zero for perspective
uniform vec3 diffuse, specular, emission;
uniform float ambient, alpha, shininess;
#if TEXTURED
uniform sampler2D surface_texture;
#endif
#if SHADOWS
uniform sampler2DShadow shadow_map;
uniform int shadow_light;      // index of the light that casts them
uniform float shadow_texel;    // 1 / side of the shadow map
#endif
uniform vec4 light_point[LIGHTS];        // world, w: cosine of the cutoff angle
uniform vec4 light_direction[LIGHTS];    // world, unit, w: spot exponent
uniform vec4 light_attenuation[LIGHTS];  // constant, linear, quadratic, w: intensity
uniform float fade_begin_m, fade_end_m;  // into the background, before the far plane cuts
out vec4 color;

float power5(float x) {
  float square = x * x;
  return square * square * x;
}

#if SHADOWS
float lit_share() {
  vec3 at = shadow_point.xyz / shadow_point.w;
  if (shadow_point.w <= 0.0 || any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
#if SHADOWS == 1
  return texture(shadow_map, at);
#else
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 offset = vec2(float(i & 1), float(i >> 1)) * 1.5 - 0.75;
    sum += texture(shadow_map, vec3(at.xy + shadow_texel * offset, at.z));
  }
  return 0.25 * sum;
#endif
}
#endif

void main() {
  vec3 to_eye = eye - point;
  float distance_m = length(to_eye);
  vec3 v = view_back == vec3(0.0) ? to_eye / distance_m : view_back;
  vec3 n = normalize(direction);
  if (dot(n, v) < 0.0) n = -n;  // seen from behind: files wind their triangles either way
#if TEXTURED
  vec4 texel = texture(surface_texture, uv);
#else
  const vec4 texel = vec4(1.0);
#endif
  vec3 albedo = mix(diffuse * texel.rgb, body_tint.rgb, body_tint.a);

  // Surrounding light: bluish white from above, warm grey from the ground.
  vec3 around = mix(vec3(0.15, 0.145, 0.14), vec3(0.38, 0.40, 0.43), 0.5 + 0.5 * n.z);
  vec3 sum = emission + albedo * around * ambient;
  // What polished surfaces show of it, more at grazing angles.
  float grazing = power5(1.0 - max(dot(n, v), 0.0));
  vec3 mirrored = reflect(-v, n);
  sum += (specular + (vec3(1.0) - specular) * grazing * 0.25) * mix(0.25, 0.8, smoothstep(-0.3, 0.6, mirrored.z)) *
         min(1.0, shininess / 64.0);
#if SHADOWS
  float lit = lit_share();
#endif
  // No branches: where the processor draws, both ways of one are computed anyway.
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 to_light = light_point[i].xyz - point;
    float d = length(to_light);
    vec3 l = to_light / max(d, 1e-6);
    float along = dot(-l, light_direction[i].xyz);
    float cone = light_point[i].w;
    float strength = light_attenuation[i].w * smoothstep(cone, mix(cone, 1.0, 0.35), along) *
                     pow(max(along, 1e-4), light_direction[i].w) * max(dot(n, l), 0.0) /
                     max(dot(light_attenuation[i].xyz, vec3(1.0, d, d * d)), 1e-3);
#if SHADOWS
    strength *= i == shadow_light ? lit : 1.0;
#endif
    vec3 h = normalize(l + v);
    // Blinn-Phong, its power of the cosine by the Gaussian that it nearly is, scaled so that a sharper highlight is brighter and no
    // energy is made (Akenine-Moeller et al.).
    float highlight = (shininess + 8.0) / 8.0 * exp2(1.442695 * shininess * (min(dot(n, h), 1.0) - 1.0));
    vec3 fresnel = specular + (vec3(1.0) - specular) * power5(1.0 - max(dot(h, v), 0.0));
    sum += strength * (albedo + fresnel * highlight);
  }
  vec3 shown = srgb(tone_mapped(sum));
  shown = mix(shown, sky(-v.z), smoothstep(fade_begin_m, fade_end_m, distance_m));
  color = vec4(shown, alpha * texel.a);
}
)";

constexpr const char* kBackgroundVertex = R"(
in vec3 position;
uniform vec3 ahead, aside, above;  // of the view, world; aside and above scaled to the picture's edges
out vec3 ray;
void main() {
  ray = ahead + position.x * aside + position.y * above;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}
)";

constexpr const char* kBackgroundFragment = R"(
in vec3 ray;
out vec4 color;
void main() { color = vec4(sky(normalize(ray).z), 1.0); }
)";

constexpr const char* kFlatVertex = R"(
in vec4 position;
in vec4 tone;
in vec2 texcoord;
out vec4 shade;
out vec2 uv;
void main() {
  shade = tone;
  uv = texcoord;
  gl_Position = position;
}
)";

// Texture coordinates below zero: no texture.
constexpr const char* kFlatFragment = R"(
in vec4 shade;
in vec2 uv;
uniform sampler2D font;
out vec4 color;
void main() { color = vec4(shade.rgb, shade.a * (uv.x < 0.0 ? 1.0 : texture(font, uv).r)); }
)";

std::string head(const MeshVariant& variant) {
  return std::string(kVersion) + "#define LIGHTS " + std::to_string(variant.lights) + "\n#define SHADOWS " +
         std::to_string(variant.shadow_taps) + "\n#define TEXTURED " + (variant.textured ? "1" : "0") + "\n";
}

}  // namespace

std::string mesh_vertex_shader(const MeshVariant& variant) { return head(variant) + kPlace + kMeshVertex; }

std::string mesh_fragment_shader(const MeshVariant& variant) { return head(variant) + kDisplay + kSky + kMeshFragment; }

std::string shadow_vertex_shader() {
  return std::string(kVersion) + kPlace + "void main() { gl_Position = world_to_clip * vec4(in_world(), 1.0); }\n";
}

std::string shadow_fragment_shader() { return std::string(kVersion) + "void main() {}\n"; }
std::string background_vertex_shader() { return std::string(kVersion) + kBackgroundVertex; }
std::string background_fragment_shader() { return std::string(kVersion) + kSky + kBackgroundFragment; }
std::string flat_vertex_shader() { return std::string(kVersion) + kFlatVertex; }
std::string flat_fragment_shader() { return std::string(kVersion) + kFlatFragment; }

}  // namespace ambf::render
