// Shadow coordinates from the eye planes, as shaders of the compatibility profile compute them; some pass three
// components.
attribute vec3 aPosition;
attribute vec3 aTexCoord;
void main(void)
{
   vec4 eye = gl_ModelViewMatrix * gl_Vertex;
   vec3 point = vec3(eye);
   gl_TexCoord[0] = gl_TextureMatrix[0] * vec4(aTexCoord, 1.0);
   float s = dot(gl_EyePlaneS[1], eye);
   float t = dot( gl_EyePlaneT[1], point );
   gl_TexCoord[1] = vec4(s, t, dot(gl_EyePlaneR[1], eye), dot(gl_EyePlaneQ[1], eye));
   gl_Position = ftransform();
}
