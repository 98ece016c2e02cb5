#version 120
// Green where every name of the fixed-function state that is checked has its value; else red.
varying float vGood;
varying vec4 lights[gl_MaxLights];

bool same(vec4 a, vec4 b) { return distance(a, b) < 1e-3; }
bool same(mat4 m, mat4 n)
{
  return same(m[0], n[0]) && same(m[1], n[1]) && same(m[2], n[2]) && same(m[3], n[3]);
}

void main()
{
  const mat4 identity = mat4(1.0);
  bool good = gl_MaxLights == 8 && gl_MaxClipPlanes >= 6 && gl_MaxTextureCoords >= 2 && gl_MaxTextureUnits >= 2;
  good = good && same(gl_TextureMatrix[0], identity) && same(gl_TextureMatrixInverseTranspose[7], identity);
  good = good && same(gl_ModelViewMatrix * gl_ModelViewMatrixInverse, identity);
  good = good && same(gl_ProjectionMatrixInverseTranspose * gl_ProjectionMatrixTranspose, identity);
  good = good && same(gl_ModelViewProjectionMatrixInverseTranspose, transpose(gl_ModelViewProjectionMatrixInverse));
  good = good && same(gl_EyePlaneS[0], vec4(1.0, 0.0, 0.0, 0.0)) && same(gl_ObjectPlaneT[3], vec4(0.0, 1.0, 0.0, 0.0));
  good = good && same(gl_EyePlaneR[2], vec4(0.0)) && same(gl_ObjectPlaneQ[1], vec4(0.0));
  good = good && same(gl_ClipPlane[0], vec4(0.0)) && same(gl_TextureEnvColor[0], vec4(0.0));
  good = good && gl_Point.size == 1.0 && gl_Fog.scale == 1.0 && gl_NormalScale == 1.0;
  good = good && gl_DepthRange.near == 0.0 && gl_DepthRange.far == 1.0 && gl_DepthRange.diff == 1.0;
  good = good && same(gl_LightModel.ambient, vec4(0.2, 0.2, 0.2, 1.0));
  good = good && same(gl_SecondaryColor, vec4(0.0, 0.0, 0.0, 1.0)) && gl_FogCoord == 0.0;
  // The first is a spot light, the others are off.
  good = good && same(gl_LightSource[0].diffuse, vec4(1.0)) && gl_LightSource[0].spotCosCutoff > 0.0;
  good = good && distance(length(gl_LightSource[0].halfVector), 1.0) < 1e-3;
  for (int i = 1; i < gl_MaxLights; ++i) {
    good = good && same(gl_FrontLightProduct[i].diffuse, vec4(0.0, 0.0, 0.0, gl_FrontMaterial.diffuse.a));
    good = good && gl_FrontLightProduct[i].ambient.rgb == vec3(0.0) && gl_BackLightProduct[i].specular.rgb == vec3(0.0);
    good = good && gl_LightSource[i].spotCosCutoff == -1.0 && gl_LightSource[i].constantAttenuation == 1.0;
    lights[i] = gl_LightSource[i].position;
  }
  lights[0] = gl_LightSource[0].position;
  vGood = good ? 1.0 : 0.0;
  gl_FrontSecondaryColor = vec4(0.0, vGood, 0.0, 1.0);
  gl_TexCoord[1] = gl_MultiTexCoord0;
  gl_PointSize = 1.0;
  gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex;
  gl_Position = ftransform();
}
