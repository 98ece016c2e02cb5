// The point of each pixel, from the depth buffer back through the projection.
uniform sampler2D depthMap;
varying vec2 place;
void main() {
  float depth = texture2D(depthMap, place).r;
  vec4 seen = gl_ProjectionMatrixInverse * vec4(2.0 * vec3(place, depth) - 1.0, 1.0);
  gl_FragColor = vec4(seen.xyz / seen.w, depth < 1.0 ? 1.0 : 0.0);
}
