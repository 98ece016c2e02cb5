#version 130
attribute vec3 aPosition;
attribute vec3 aNormal;
attribute vec2 aTexCoord;
attribute vec3 aTangent;
attribute vec3 aBitangent;
varying vec3 vTangent, vBitangent, vNormal, vPoint;
void main() {
  gl_TexCoord[0] = vec4(aTexCoord, 0.0, 1.0);
  vNormal = gl_NormalMatrix * aNormal;
  vTangent = gl_NormalMatrix * aTangent;
  vBitangent = gl_NormalMatrix * aBitangent;
  vPoint = vec3(gl_ModelViewMatrix * vec4(aPosition, 1.0));
  gl_Position = gl_ModelViewProjectionMatrix * vec4(aPosition, 1.0);
}
