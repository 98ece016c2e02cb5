// As a sensor that sees everything at half its distance, and nothing in the left half of its picture.
uniform sampler2D depthMap;
uniform float nearPlane, farPlane, fieldOfView;
uniform vec2 imageSize;
varying vec2 place;
void main() {
  float depth = texture2D(depthMap, place).r;
  float ahead = 0.5 * nearPlane * farPlane / (farPlane - depth * (farPlane - nearPlane));
  vec2 slope = (2.0 * place - 1.0) * tan(0.5 * fieldOfView) * vec2(imageSize.x / imageSize.y, 1.0);
  gl_FragColor = vec4(slope * ahead, -ahead, depth < 1.0 && place.x > 0.5 ? 1.0 : 0.0);
}
