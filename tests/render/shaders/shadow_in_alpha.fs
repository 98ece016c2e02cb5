// Shadows as shaders of the original's users write them: its alpha test read them.
uniform sampler2DShadow shadowMap;
void main(void)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < gl_MaxLights; ++i) sum += gl_FrontLightProduct[i].diffuse.rgb;
    vec4 shadow = shadow2DProj(shadowMap, gl_TexCoord[1]);
    gl_FragColor = vec4(sum, shadow.a);
}
