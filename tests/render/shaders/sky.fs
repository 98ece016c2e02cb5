#version 120
uniform samplerCube sky;
varying vec3 vRay;
void main() {
  // World axes to the cube's: front lies along -x, right along +y, and the cube has its top at -y.
  gl_FragColor = textureCube(sky, vec3(vRay.y, -vRay.z, -vRay.x));
}
