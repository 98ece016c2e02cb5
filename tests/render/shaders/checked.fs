#version 120
// A texture under a name that is a function today, in stripes.
uniform sampler2D texture;
varying vec2 uv;
void main() {
  float smooth = step(0.5, fract(uv.x * 4.0));
  gl_FragColor = mix(texture2D(texture, uv), vec4(0.1, 0.1, 0.3, 1.0), smooth);
}
