// Bands of light, as in drawings. GLSL 1.20, fixed-function names throughout.
varying vec3 vNormal;
varying vec3 vEye;
void main() {
  vNormal = gl_NormalMatrix * gl_Normal;
  vEye = vec3(gl_ModelViewMatrix * gl_Vertex);
  gl_FrontColor = gl_FrontMaterial.diffuse;
  gl_Position = ftransform();
}
