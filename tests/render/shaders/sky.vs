#version 120
attribute vec3 aPosition;
varying vec3 vRay;
void main() {
  vRay = aPosition;
  gl_Position = (gl_ModelViewProjectionMatrix * vec4(aPosition, 1.0)).xyww;
}
