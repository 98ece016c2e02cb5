// Each body in its plain colour, as for a mask.
void main() { gl_FragColor = vec4(gl_FrontMaterial.diffuse.rgb, 1.0); }
