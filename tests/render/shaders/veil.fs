// The file's colour, as transparent as the file says.
void main() { gl_FragColor = gl_FrontMaterial.diffuse; }
