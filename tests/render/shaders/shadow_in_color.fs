// White where the light comes, black in its shadow.
uniform sampler2DShadow shadowMap;
void main(void)
{
    gl_FragColor = vec4(shadow2DProj(shadowMap, gl_TexCoord[1]).rgb, 1.0);
}
