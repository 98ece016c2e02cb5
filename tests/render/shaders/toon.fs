#version 120
varying vec3 vNormal;
varying vec3 vEye;
void main() {
  vec3 n = normalize(vNormal);
  vec3 l = normalize(gl_LightSource[0].position.xyz - vEye);
  float light = max(dot(n, l), 0.0);
  float band = light > 0.8 ? 1.0 : light > 0.35 ? 0.65 : 0.3;
  float edge = dot(n, normalize(-vEye)) < 0.3 ? 0.0 : 1.0;
  gl_FragColor = vec4(gl_Color.rgb * band * edge, gl_Color.a);
}
