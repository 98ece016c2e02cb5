// The OpenGL 3.3 core functions we call, as members of a table that is filled from whichever backend made the context
// (GLFW, OSMesa, EGL). No loader library: they assume one window system. The table belongs to one context's thread
// (main). Private to render/.
#pragma once

#include <GL/glcorearb.h>

#include <functional>
#include <string>

namespace ambf::render {

// X(member, name without "gl" in capitals)
#define AMBF_GL_FUNCTIONS(X)                                        \
  X(ActiveTexture, ACTIVETEXTURE)                                   \
  X(AttachShader, ATTACHSHADER)                                     \
  X(BindAttribLocation, BINDATTRIBLOCATION)                         \
  X(BindBuffer, BINDBUFFER)                                         \
  X(BindFramebuffer, BINDFRAMEBUFFER)                               \
  X(BindRenderbuffer, BINDRENDERBUFFER)                             \
  X(BindSampler, BINDSAMPLER)                                       \
  X(BindTexture, BINDTEXTURE)                                       \
  X(BindVertexArray, BINDVERTEXARRAY)                               \
  X(BlendFunc, BLENDFUNC)                                           \
  X(BlendFuncSeparate, BLENDFUNCSEPARATE)                           \
  X(BlitFramebuffer, BLITFRAMEBUFFER)                               \
  X(BufferData, BUFFERDATA)                                         \
  X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)                 \
  X(Clear, CLEAR)                                                   \
  X(ClearColor, CLEARCOLOR)                                         \
  X(ClearDepth, CLEARDEPTH)                                         \
  X(ClientWaitSync, CLIENTWAITSYNC)                                 \
  X(ColorMask, COLORMASK)                                           \
  X(CompileShader, COMPILESHADER)                                   \
  X(CullFace, CULLFACE)                                             \
  X(CreateProgram, CREATEPROGRAM)                                   \
  X(CreateShader, CREATESHADER)                                     \
  X(DeleteBuffers, DELETEBUFFERS)                                   \
  X(DeleteFramebuffers, DELETEFRAMEBUFFERS)                         \
  X(DeleteProgram, DELETEPROGRAM)                                   \
  X(DeleteRenderbuffers, DELETERENDERBUFFERS)                       \
  X(DeleteSamplers, DELETESAMPLERS)                                 \
  X(DeleteShader, DELETESHADER)                                     \
  X(DeleteSync, DELETESYNC)                                         \
  X(DeleteTextures, DELETETEXTURES)                                 \
  X(DeleteVertexArrays, DELETEVERTEXARRAYS)                         \
  X(DepthFunc, DEPTHFUNC)                                           \
  X(DepthMask, DEPTHMASK)                                           \
  X(Disable, DISABLE)                                               \
  X(DisableVertexAttribArray, DISABLEVERTEXATTRIBARRAY)             \
  X(DrawArrays, DRAWARRAYS)                                         \
  X(DrawArraysInstanced, DRAWARRAYSINSTANCED)                       \
  X(DrawElementsInstanced, DRAWELEMENTSINSTANCED)                   \
  X(Enable, ENABLE)                                                 \
  X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY)               \
  X(FenceSync, FENCESYNC)                                           \
  X(Finish, FINISH)                                                 \
  X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER)               \
  X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D)                     \
  X(GenBuffers, GENBUFFERS)                                         \
  X(GenFramebuffers, GENFRAMEBUFFERS)                               \
  X(GenRenderbuffers, GENRENDERBUFFERS)                             \
  X(GenSamplers, GENSAMPLERS)                                       \
  X(GenTextures, GENTEXTURES)                                       \
  X(GenVertexArrays, GENVERTEXARRAYS)                               \
  X(GenerateMipmap, GENERATEMIPMAP)                                 \
  X(GetError, GETERROR)                                             \
  X(GetActiveUniform, GETACTIVEUNIFORM)                             \
  X(GetFloatv, GETFLOATV)                                           \
  X(GetIntegerv, GETINTEGERV)                                       \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG)                           \
  X(GetProgramiv, GETPROGRAMIV)                                     \
  X(GetShaderInfoLog, GETSHADERINFOLOG)                             \
  X(GetShaderiv, GETSHADERIV)                                       \
  X(GetString, GETSTRING)                                           \
  X(GetUniformLocation, GETUNIFORMLOCATION)                         \
  X(LineWidth, LINEWIDTH)                                           \
  X(LinkProgram, LINKPROGRAM)                                       \
  X(MapBufferRange, MAPBUFFERRANGE)                                 \
  X(PixelStorei, PIXELSTOREI)                                       \
  X(PolygonOffset, POLYGONOFFSET)                                   \
  X(ReadBuffer, READBUFFER)                                         \
  X(DrawBuffer, DRAWBUFFER)                                         \
  X(ReadPixels, READPIXELS)                                         \
  X(RenderbufferStorageMultisample, RENDERBUFFERSTORAGEMULTISAMPLE) \
  X(SamplerParameteri, SAMPLERPARAMETERI)                           \
  X(Scissor, SCISSOR)                                               \
  X(ShaderSource, SHADERSOURCE)                                     \
  X(TexImage2D, TEXIMAGE2D)                                         \
  X(TexParameterf, TEXPARAMETERF)                                   \
  X(TexParameteri, TEXPARAMETERI)                                   \
  X(Uniform1f, UNIFORM1F)                                           \
  X(Uniform1i, UNIFORM1I)                                           \
  X(Uniform2f, UNIFORM2F)                                           \
  X(Uniform3f, UNIFORM3F)                                           \
  X(Uniform4f, UNIFORM4F)                                           \
  X(UniformMatrix3fv, UNIFORMMATRIX3FV)                             \
  X(UniformMatrix4fv, UNIFORMMATRIX4FV)                             \
  X(UnmapBuffer, UNMAPBUFFER)                                       \
  X(UseProgram, USEPROGRAM)                                         \
  X(VertexAttrib4f, VERTEXATTRIB4F)                                 \
  X(VertexAttribDivisor, VERTEXATTRIBDIVISOR)                       \
  X(VertexAttribPointer, VERTEXATTRIBPOINTER)                       \
  X(Viewport, VIEWPORT)

struct Gl {
#define AMBF_GL_MEMBER(member, name) PFNGL##name##PROC member = nullptr;
  AMBF_GL_FUNCTIONS(AMBF_GL_MEMBER)
#undef AMBF_GL_MEMBER

  // Asks `address_of` for each function. False when one is missing, with its name in `missing`.
  bool load(const std::function<void*(const char*)>& address_of, std::string& missing);
};

// Does the machine's processor draw (Mesa's llvmpipe, softpipe or swrast)? Then pictures cost physics time.
bool draws_in_software(const Gl& gl);

}  // namespace ambf::render
