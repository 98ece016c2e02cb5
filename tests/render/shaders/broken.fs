#version 120
void main() {
  vec3 color = vec3(1.0, 0.5, 0.0);
  gl_FragColor = vec4(colour, 1.0);
}
