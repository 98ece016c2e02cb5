#version 120
varying float vGood;
varying vec4 lights[gl_MaxLights];
uniform sampler2D metallicMap, roughnessMap, aoMap;
uniform sampler3D uVolume;
uniform int uTextureEnabled;
void main()
{
  bool good = vGood > 0.999 && gl_SecondaryColor.g > 0.999 && lights[7] == vec4(0.0, 0.0, 1.0, 0.0);
  good = good && texture2D(metallicMap, gl_TexCoord[1].xy).r == 0.0 && texture2D(roughnessMap, vec2(0.5)).r == 1.0;
  good = good && texture2D(aoMap, vec2(0.5)).r == 1.0 && texture3D(uVolume, vec3(0.5)).r == 0.0 && uTextureEnabled == 0;
  gl_FragDepth = gl_FragCoord.z;
  gl_FragData[0] = good ? vec4(0.0, 1.0, 0.0, 1.0) : vec4(1.0, 0.0, 0.0, 1.0);
}
