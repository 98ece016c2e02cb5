#version 130
// A normal map by the names that files know: normalMap, vEnableNormalMapping, aTangent, aBitangent.
uniform sampler2D normalMap;
uniform sampler2D shadowMap;
uniform int vEnableNormalMapping;
varying vec3 vTangent, vBitangent, vNormal, vPoint;
void main() {
  vec3 n = normalize(vNormal);
  if (vEnableNormalMapping == 1) {
    vec3 bump = 2.0 * texture2D(normalMap, gl_TexCoord[0].st).xyz - 1.0;
    n = normalize(mat3(normalize(vTangent), normalize(vBitangent), n) * bump);
  }
  vec3 l = normalize(gl_LightSource[0].position.xyz - vPoint);
  vec3 h = normalize(l - normalize(vPoint));
  vec4 color = gl_FrontLightModelProduct.sceneColor + gl_FrontLightProduct[0].diffuse * max(dot(n, l), 0.0) +
               gl_FrontLightProduct[0].specular * pow(max(dot(n, h), 0.0), gl_FrontMaterial.shininess);
  gl_FragColor = vec4(color.rgb, 1.0);
}
