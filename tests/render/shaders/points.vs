// Over the whole picture; corners are in [-1, 1], texture coordinates in [0, 1].
varying vec2 place;
void main() {
  place = gl_MultiTexCoord0.xy;
  gl_Position = ftransform();
}
