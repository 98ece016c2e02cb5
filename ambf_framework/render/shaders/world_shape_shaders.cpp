#include "render/shaders/world_shape_shaders.h"

namespace ambf::render {

// One instance a line: a quad around it in pixels, wider than it for the soft edge and a dark rim, which sets it off
// from any ground.
const char* const kDebugLineVertex = R"(#version 330 core
in vec3 from_point;
in vec3 to_point;
in vec2 half_widths;  // px; below zero: cut off straight at that end
in vec4 tone;
uniform mat4 world_to_clip;
uniform vec2 half_picture;  // px
out vec2 place;  // px, along and across
flat out float length_px;
flat out vec2 half_px;
flat out vec4 shade;
const float kNearest = 1e-6;
void main() {
  vec4 a = world_to_clip * vec4(from_point, 1.0), b = world_to_clip * vec4(to_point, 1.0);
  // Cut at the near plane, so that both ends have a place in the picture.
  float before_a = a.z + a.w, before_b = b.z + b.w;
  bool gone = before_a < kNearest && before_b < kNearest;
  vec4 from = a, to = b;
  if (before_a < kNearest) a = mix(from, to, (kNearest - before_a) / max(before_b - before_a, kNearest));
  if (before_b < kNearest) b = mix(to, from, (kNearest - before_b) / max(before_a - before_b, kNearest));
  vec2 way = (b.xy / b.w - a.xy / a.w) * half_picture;
  length_px = length(way);
  vec2 along = length_px > 1e-3 ? way / length_px : vec2(1.0, 0.0);
  half_px = half_widths;
  shade = tone;
  float reach = max(abs(half_px.x), abs(half_px.y)) + 2.0;
  int corner = int[6](0, 1, 2, 2, 1, 3)[gl_VertexID];
  bool at_end = corner >= 2;
  float side = (corner & 1) == 0 ? -1.0 : 1.0;
  vec2 offset = along * (at_end ? reach : -reach) + vec2(-along.y, along.x) * side * reach;
  place = vec2(at_end ? length_px + reach : -reach, side * reach);
  vec4 end = at_end ? b : a;
  vec3 seen = end.xyz / end.w;
  seen.xy += offset / half_picture;
  seen.z = max(seen.z - 2e-4, -1.0);  // before the surface that it lies on
  gl_Position = gone ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(seen, 1.0);  // w 1: what is between is as far as it is in pixels
}
)";

const char* const kDebugLineFragment = R"(#version 330 core
in vec2 place;
flat in float length_px;
flat in vec2 half_px;
flat in vec4 shade;
uniform float share;
out vec4 color;
void main() {
  float at = clamp(place.x, 0.0, length_px);
  float half_width = mix(abs(half_px.x), abs(half_px.y), length_px > 0.0 ? at / length_px : 0.0);
  float away = length(vec2(place.x - at, place.y)) - half_width;
  float cover = clamp(0.5 - away, 0.0, 1.0);
  float rim = 0.5 * clamp(1.5 - away, 0.0, 1.0) * clamp(2.0 * half_width - 1.0, 0.0, 1.0);
  float whole = cover + rim * (1.0 - cover);
  float alpha = whole;
  if (half_px.x < 0.0) alpha *= clamp(place.x + 0.5, 0.0, 1.0);
  if (half_px.y < 0.0) alpha *= clamp(length_px - place.x + 0.5, 0.0, 1.0);
  if (alpha <= 0.0) discard;
  color = vec4(mix(vec3(0.05, 0.06, 0.08), shade.rgb, cover / whole), shade.a * alpha * share);
}
)";

const char* const kDebugFillVertex = R"(#version 330 core
in vec3 point;
in vec4 tone;
uniform mat4 world_to_clip;
out vec4 shade;
void main() {
  shade = tone;
  gl_Position = world_to_clip * vec4(point, 1.0);
}
)";

const char* const kDebugFillFragment = R"(#version 330 core
in vec4 shade;
uniform float share;
out vec4 color;
void main() { color = vec4(shade.rgb, shade.a * share); }
)";

const char* const kDebugMeshVertex = R"(#version 330 core
in vec3 point;
in vec4 row0;
in vec4 row1;
in vec4 row2;
in vec4 face_tone;
in vec4 edge_tone;
uniform mat4 world_to_clip;
uniform int edges;
out vec3 in_world;
flat out vec4 shade;
void main() {
  vec4 p = vec4(point, 1.0);
  in_world = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  shade = edges != 0 ? edge_tone : face_tone;
  gl_Position = world_to_clip * vec4(in_world, 1.0);
  if (edges != 0) gl_Position.z -= 2e-4 * gl_Position.w;  // before the faces
}
)";

// Faces are lit from the eye, so that shapes can be read; a mesh's own normals are not asked for.
const char* const kDebugMeshFragment = R"(#version 330 core
in vec3 in_world;
flat in vec4 shade;
uniform vec3 eye;
uniform int edges;
uniform float share;
out vec4 color;
void main() {
  if (shade.a <= 0.0) discard;
  float light = 1.0;
  if (edges == 0) {
    vec3 across = cross(dFdx(in_world), dFdy(in_world));
    light = 0.55 + 0.45 * abs(dot(normalize(across + vec3(1e-20)), normalize(eye - in_world)));
  }
  color = vec4(light * shade.rgb, shade.a * share);
}
)";

}  // namespace ambf::render
