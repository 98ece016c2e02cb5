#include "render/shaders/shaders.h"

#include "render/shaders/detail/shader_parts.h"

namespace ambf::render {

namespace {

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
out vec3 point, direction;
out vec2 uv;
vec3 turned(vec3 v) { return vec3(dot(row0.xyz, v), dot(row1.xyz, v), dot(row2.xyz, v)); }
#if NORMAL_MAPPED
in vec4 tangent;
out vec4 along_u;  // w: handedness
#endif
void main() {
  point = in_world();
  direction = normalize(turned(normal));
#if NORMAL_MAPPED
  along_u = vec4(normalize(turned(tangent.xyz)), tangent.w);
#endif
  uv = texcoord;
  gl_Position = world_to_clip * vec4(point, 1.0);
}
)";

constexpr const char* kMeshInputs = R"(
in vec3 point, direction;
in vec2 uv;
uniform vec3 eye;
uniform vec3 view_back;        // for orthographic pictures; zero for perspective
uniform vec3 diffuse, specular, emission;
uniform float ambient, alpha, shininess;
uniform float metallic;                  // share that is bare metal
uniform vec3 around_up, around_down;     // surrounding light from above and from below
#if FADES
uniform float fade_begin_m, fade_end_m;  // into the background, before the far plane cuts
#endif
uniform vec4 light_point[LIGHTS];        // world, w: intensity, divided by the attenuation where that is constant
uniform vec4 light_direction[LIGHTS];    // world, unit, w: spot exponent
uniform vec3 light_attenuation[LIGHTS];  // constant, linear, quadratic
uniform vec2 light_cone[LIGHTS];         // cosine of the angle off the axis, times x, plus y: 0 at the edge, 1 inside
out vec4 color;
#if TEXTURED
uniform sampler2D surface_texture;
#endif
#if NORMAL_MAPPED
in vec4 along_u;
uniform sampler2D normal_map;
#endif
#if SKY
uniform samplerCube sky_texture;
#endif
#if PEELED
uniform sampler2D nearer_depth, opaque_depth;
#endif
)";

// Distances in the shadow maps are those of the lights' cameras.
constexpr const char* kShadow = R"(
uniform sampler2DShadow shadow_map;
uniform sampler2D shadow_depth;          // the same picture, to be read
uniform mat4 world_to_shadow[VIEWS];     // to the tile of the view
uniform vec4 shadow_tile[VIEWS];         // least u, v, greatest u, v
uniform vec4 shadow_lens[VIEWS];         // near, far, radius of the light in texels at distance 1, 1: parallel rays
uniform vec3 shadow_texel[VIEWS];        // in u and v; in m where the scene is
const float kGolden = 2.39996323;

float depth_m(vec4 lens, float z) {
  return lens.w > 0.5 ? mix(lens.x, lens.y, z) : lens.x * lens.y / (lens.y - z * (lens.y - lens.x));
}

// Evenly spread in the unit disc (Vogel).
vec2 on_disc(int i, int count, float turn) {
  float r = sqrt((float(i) + 0.5) / float(count)), a = float(i) * kGolden + turn;
  return r * vec2(cos(a), sin(a));
}

float lit_share(int view, const int kFilter, vec3 n) {
  float slant = kFilter <= 1 ? 1.0 : kFilter == 2 ? 1.5 : 2.5;  // wider filters look further along the surface
  vec4 seen = world_to_shadow[view] * vec4(point + slant * shadow_texel[view].z * n, 1.0);
  vec3 at = seen.xyz / seen.w;
  vec4 tile = shadow_tile[view];
  bool beside = any(lessThan(at.xy, tile.xy)) || any(greaterThan(at.xy, tile.zw));
  if (beside || seen.w <= 0.0 || at.z <= 0.0 || at.z >= 1.0) return 1.0;
  vec2 texel = shadow_texel[view].xy;
  if (kFilter == 1) return texture(shadow_map, at);
  float sum = 0.0;
  if (kFilter == 2) {
    for (int i = 0; i < 4; ++i) {
      vec2 offset = vec2(float(i & 1), float(i >> 1)) * 1.5 - 0.75;
      sum += texture(shadow_map, vec3(clamp(at.xy + texel * offset, tile.xy, tile.zw), at.z));
    }
    return 0.25 * sum;
  }
  // Turned from pixel to pixel, so that steps become fine grain (Jimenez' interleaved gradient noise).
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float radius = 2.5;  // texels
  if (kFilter == 4) {
    vec4 lens = shadow_lens[view];
    float here_m = depth_m(lens, at.z);
    float reach = lens.w > 0.5 ? lens.z * (here_m - lens.x) : lens.z * (here_m - lens.x) / (lens.x * here_m);
    float search = clamp(reach, 3.0, 24.0), blocker_m = 0.0, blockers = 0.0;
    for (int i = 0; i < 12; ++i) {
      vec2 where = clamp(at.xy + search * texel * on_disc(i, 12, turn), tile.xy, tile.zw);
      float m = depth_m(lens, texture(shadow_depth, where).r);
      float nearer = step(m, here_m * (1.0 - 1e-4) - slant * shadow_texel[view].z);
      blocker_m += nearer * m;
      blockers += nearer;
    }
    if (blockers == 0.0) return 1.0;
    blocker_m /= blockers;
    // Similar triangles: what an extended light leaves half lit (Fernando, Percentage-Closer Soft Shadows).
    float penumbra = lens.z * (here_m - blocker_m) / (lens.w > 0.5 ? 1.0 : blocker_m * here_m);
    radius = clamp(penumbra, 1.0, 24.0);
  }
  for (int i = 0; i < 16; ++i) {
    vec2 where = clamp(at.xy + radius * texel * on_disc(i, 16, turn), tile.xy, tile.zw);
    sum += texture(shadow_map, vec3(where, at.z));
  }
  return sum / 16.0;
}

// Of the six views of a point light: +x, -x, +y, -y, +z, -z.
int face_of(vec3 d) {
  vec3 a = abs(d);
  if (a.x >= a.y && a.x >= a.z) return d.x > 0.0 ? 0 : 1;
  if (a.y >= a.z) return d.y > 0.0 ? 2 : 3;
  return d.z > 0.0 ? 4 : 5;
}
)";

// One light, its kind and filter known when this is compiled. No branches on what is not: where the processor draws,
// both ways of one are computed anyway.
constexpr const char* kShine = R"(
float power5(float x) {
  float square = x * x;
  return square * square * x;
}

// What it sends to the eye by way of the albedo, of the mirror at normal incidence, and of the mirror's rest at a
// slant. n: on the side that is seen, seen_slant: its cosine with v.
vec3 shine(const int kLight, const int kKind, const bool kFocused, const bool kAttenuated, const int kFilter,
           const int kViews, const int kFirstView, vec3 n, vec3 v, float seen_slant) {
  vec3 to_light = light_point[kLight].xyz - point;
  float square = max(dot(to_light, to_light), 1e-12), inverse = inversesqrt(square);
  vec3 l = kKind == 2 ? -light_direction[kLight].xyz : to_light * inverse;
  float slant = dot(n, l), strength = light_point[kLight].w * max(slant, 0.0);
  if (kAttenuated) {
    strength /= max(dot(light_attenuation[kLight], vec3(1.0, square * inverse, square)), 1e-3);
  }
  if (kKind == 0) {
    float along = -dot(l, light_direction[kLight].xyz);
    float inside = clamp(along * light_cone[kLight].x + light_cone[kLight].y, 0.0, 1.0);
    strength *= inside * inside * (3.0 - 2.0 * inside);
    if (kFocused) strength *= pow(max(along, 1e-4), light_direction[kLight].w);
  }
#if VIEWS
  if (kFilter > 0) {
    vec3 outwards = normalize(direction);
    if (dot(outwards, l) < 0.0) outwards = -outwards;
    strength *= lit_share(kFirstView + (kViews == 6 ? face_of(-to_light) : 0), kFilter, outwards);
  }
#endif
  // Of the vector h halfway between l and v, only its cosines with both (one value) and with n.
  float both = max(1.0 + dot(l, v), 1e-6), inverse_h = 0.70710678 * inversesqrt(both);
  float halfway = both * inverse_h, aligned = min((slant + seen_slant) * inverse_h, 1.0);
  // Blinn-Phong, its power of the cosine by the Gaussian that it nearly is, scaled so that a sharper highlight is
  // brighter and no energy is made (Akenine-Moeller et al.).
  float highlight = strength * (0.125 * shininess + 1.0) * exp2(1.442695 * shininess * (aligned - 1.0));
  return vec3(strength, highlight, highlight * power5(1.0 - min(halfway, 1.0)));
}
)";

// What is mirrored where there is no skybox. Plastics show a soft gradient; metals, whose whole look it is, a room: a
// dark floor, grey walls, a bright ceiling and windows, all of them as blurred as the metal is rough. Only functions
// of the direction, no texture.
constexpr const char* kSurroundings = R"(
vec3 plain_surroundings(vec3 m) { return around_up * mix(0.66, 2.0, smoothstep(-0.3, 0.6, m.z)); }
#if METALLIC
float edge(float at, float blur, float x) { return smoothstep(at - blur, at + blur, x); }
vec3 room(vec3 m) {
  float blur = 0.06 + 1.4 * inversesqrt(shininess + 2.0);
  float ceiling = edge(0.62, blur, m.z), walls = edge(-0.05, blur, m.z);
  // Three windows around, so that whatever is round shows bright and dark stripes: cos(3 a) of the azimuth a.
  vec2 d = m.xy * inversesqrt(dot(m.xy, m.xy) + 1e-3);
  float window = edge(0.5, 2.0 * blur, d.x * (d.x * d.x - 3.0 * d.y * d.y)) * (1.0 + 0.5 * d.x);
  vec3 wall = around_up * (0.4 + 2.5 * window);
  vec3 ground = around_down * (1.8 + 2.0 * window);  // the floor shines, too
  return mix(mix(ground, wall, walls), 2.6 * around_up, ceiling);
}
#endif
)";

constexpr const char* kMeshMain = R"(
void main() {
#if PEELED
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (gl_FragCoord.z <= texelFetch(nearer_depth, pixel, 0).r + 1e-7 ||
      gl_FragCoord.z > texelFetch(opaque_depth, pixel, 0).r) discard;
#endif
  vec3 to_eye = eye - point;
  float square = dot(to_eye, to_eye), inverse = inversesqrt(square);
  vec3 v = view_back == vec3(0.0) ? to_eye * inverse : view_back;
  vec3 n = normalize(direction);
  if (dot(n, v) < 0.0) n = -n;  // seen from behind: files wind their triangles either way
#if TEXTURED
  vec4 texel = texture(surface_texture, uv);
#if CUT_OUT
  if (texel.a < 0.5) discard;
  texel.a = 1.0;
#endif
#else
  const vec4 texel = vec4(1.0);
#endif
#if NORMAL_MAPPED
  vec3 bump = 2.0 * texture(normal_map, uv).xyz - 1.0;
  vec3 t = normalize(along_u.xyz - n * dot(n, along_u.xyz));
  n = normalize(bump.x * t + bump.y * along_u.w * cross(n, t) + max(bump.z, 0.05) * n);
#endif
  vec3 albedo = diffuse * texel.rgb;
#if METALLIC
  vec3 mirror = mix(specular, albedo, metallic);
  albedo *= 1.0 - metallic;
#else
  vec3 mirror = specular;
#endif

  vec3 sum = emission + albedo * mix(around_down, around_up, 0.5 + 0.5 * n.z) * ambient;
  // What polished surfaces show of their surroundings, more at grazing angles.
  float seen_slant = dot(n, v), grazing = power5(1.0 - max(seen_slant, 0.0));
  vec3 mirrored = reflect(-v, n);
#if SKY
  vec3 in_cube = vec3(mirrored.y, mirrored.z, -mirrored.x);
  vec3 surroundings = textureLod(sky_texture, in_cube, 6.0 - 0.6 * log2(shininess)).rgb;
#elif METALLIC
  vec3 surroundings = mix(plain_surroundings(mirrored), room(mirrored), metallic);
#else
  vec3 surroundings = plain_surroundings(mirrored);
#endif
  // A rough metal mirrors as much, only blurred; a rough plastic hardly does.
#if METALLIC
  surroundings *= mix(min(1.0, shininess / 64.0), 1.0, metallic);
#else
  surroundings *= min(1.0, shininess / 64.0);
#endif
  sum += (mirror + (vec3(1.0) - mirror) * (0.25 * grazing)) * surroundings;
  vec3 light = all_lights(n, v, seen_slant);
  sum += albedo * light.x + mirror * light.y + (vec3(1.0) - mirror) * light.z;
  vec3 shown = srgb(tone_mapped(sum));
#if FADES
#if SKY
  vec3 beyond = srgb(texture(sky_texture, vec3(-v.y, -v.z, v.x)).rgb);
#else
  vec3 beyond = sky(-v.z);
#endif
  shown = mix(shown, beyond, smoothstep(fade_begin_m, fade_end_m, square * inverse));
#endif
  color = vec4(shown, alpha * texel.a);
}
)";

int view_count(const MeshVariant& variant) {
  int count = 0;
  for (const LightVariant& light : variant.lights) count += light.shadow_views;
  return count;
}

std::string head(const MeshVariant& variant) {
  std::string text = kVersion;
  const auto define = [&](const char* name, int value) {
    text += "#define " + std::string(name) + " " + std::to_string(value) + "\n";
  };
  define("LIGHTS", static_cast<int>(variant.lights.size()));
  define("VIEWS", view_count(variant));
  define("TEXTURED", variant.textured ? 1 : 0);
  define("CUT_OUT", variant.cut_out ? 1 : 0);
  define("NORMAL_MAPPED", variant.normal_mapped ? 1 : 0);
  define("METALLIC", variant.metallic ? 1 : 0);
  define("SKY", variant.sky ? 1 : 0);
  define("FADES", variant.fades ? 1 : 0);
  define("PEELED", variant.peeled ? 1 : 0);
  return text;
}

// vec3 all_lights(...): a call of shine() for each.
std::string all_lights(const MeshVariant& variant) {
  std::string text = "vec3 all_lights(vec3 n, vec3 v, float seen_slant) {\n  return vec3(0.0)";
  int first_view = 0;
  for (std::size_t i = 0; i < variant.lights.size(); ++i) {
    const LightVariant& light = variant.lights[i];
    text += " + shine(" + std::to_string(i) + ", " + std::to_string(static_cast<int>(light.kind)) + ", " +
            (light.focused ? "true, " : "false, ") + (light.attenuated ? "true, " : "false, ") +
            std::to_string(static_cast<int>(light.filter)) + ", " + std::to_string(light.shadow_views) + ", " +
            std::to_string(first_view) + ", n, v, seen_slant)";
    first_view += light.shadow_views;
  }
  return text + ";\n}\n";
}

}  // namespace

std::string mesh_vertex_shader(const MeshVariant& variant) { return head(variant) + kPlace + kMeshVertex; }

std::string mesh_fragment_shader(const MeshVariant& variant) {
  return head(variant) + kDisplay + kSky + kMeshInputs + (view_count(variant) > 0 ? kShadow : "") + kShine +
         all_lights(variant) + kSurroundings + kMeshMain;
}

std::string shadow_vertex_shader() {
  return std::string(kVersion) + kPlace + "void main() { gl_Position = world_to_clip * vec4(in_world(), 1.0); }\n";
}

std::string shadow_fragment_shader() { return std::string(kVersion) + "void main() {}\n"; }

}  // namespace ambf::render
