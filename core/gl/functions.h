#pragma once

#include <GL/glcorearb.h>
#include <functional>

// Every OpenGL entry point that the project calls; glNAME becomes Functions::NAME.
// clang-format off
#define HRT_GL_FUNCTIONS(X)                                                                        \
  X(GETSTRING, GetString) X(GETINTEGERV, GetIntegerv) X(GETERROR, GetError)                        \
  X(ENABLE, Enable) X(DEPTHFUNC, DepthFunc) X(DEPTHMASK, DepthMask)                                \
  X(VIEWPORT, Viewport) X(CLIPCONTROL, ClipControl) X(PIXELSTOREI, PixelStorei)                    \
  X(CREATETEXTURES, CreateTextures) X(DELETETEXTURES, DeleteTextures)                              \
  X(TEXTURESTORAGE2D, TextureStorage2D) X(TEXTURESTORAGE3D, TextureStorage3D)                      \
  X(TEXTUREPARAMETERI, TextureParameteri) X(TEXTUREBUFFER, TextureBuffer)                          \
  X(TEXTURESUBIMAGE2D, TextureSubImage2D) X(TEXTURESUBIMAGE3D, TextureSubImage3D)                  \
  X(BINDTEXTUREUNIT, BindTextureUnit) X(BINDIMAGETEXTURE, BindImageTexture)                        \
  X(GETTEXTUREIMAGE, GetTextureImage)                                                              \
  X(CREATEBUFFERS, CreateBuffers) X(DELETEBUFFERS, DeleteBuffers) X(BINDBUFFER, BindBuffer)        \
  X(NAMEDBUFFERSTORAGE, NamedBufferStorage) X(MAPNAMEDBUFFERRANGE, MapNamedBufferRange)            \
  X(CREATEFRAMEBUFFERS, CreateFramebuffers) X(DELETEFRAMEBUFFERS, DeleteFramebuffers)              \
  X(NAMEDFRAMEBUFFERTEXTURE, NamedFramebufferTexture)                                              \
  X(NAMEDFRAMEBUFFERDRAWBUFFER, NamedFramebufferDrawBuffer)                                        \
  X(NAMEDFRAMEBUFFERREADBUFFER, NamedFramebufferReadBuffer)                                        \
  X(CHECKNAMEDFRAMEBUFFERSTATUS, CheckNamedFramebufferStatus) X(BINDFRAMEBUFFER, BindFramebuffer)  \
  X(CLEARNAMEDFRAMEBUFFERFV, ClearNamedFramebufferfv)                                              \
  X(CLEARNAMEDFRAMEBUFFERUIV, ClearNamedFramebufferuiv)                                            \
  X(CREATEVERTEXARRAYS, CreateVertexArrays) X(DELETEVERTEXARRAYS, DeleteVertexArrays)              \
  X(VERTEXARRAYVERTEXBUFFER, VertexArrayVertexBuffer)                                              \
  X(VERTEXARRAYELEMENTBUFFER, VertexArrayElementBuffer)                                            \
  X(VERTEXARRAYATTRIBFORMAT, VertexArrayAttribFormat)                                              \
  X(VERTEXARRAYATTRIBBINDING, VertexArrayAttribBinding)                                            \
  X(ENABLEVERTEXARRAYATTRIB, EnableVertexArrayAttrib) X(BINDVERTEXARRAY, BindVertexArray)          \
  X(CREATESHADER, CreateShader) X(DELETESHADER, DeleteShader) X(SHADERSOURCE, ShaderSource)        \
  X(COMPILESHADER, CompileShader) X(GETSHADERIV, GetShaderiv)                                      \
  X(GETSHADERINFOLOG, GetShaderInfoLog) X(CREATEPROGRAM, CreateProgram)                            \
  X(DELETEPROGRAM, DeleteProgram) X(ATTACHSHADER, AttachShader) X(LINKPROGRAM, LinkProgram)        \
  X(GETPROGRAMIV, GetProgramiv) X(GETPROGRAMINFOLOG, GetProgramInfoLog) X(USEPROGRAM, UseProgram)  \
  X(GETUNIFORMLOCATION, GetUniformLocation) X(PROGRAMUNIFORM1I, ProgramUniform1i)                  \
  X(PROGRAMUNIFORM1F, ProgramUniform1f) X(PROGRAMUNIFORM3FV, ProgramUniform3fv)                    \
  X(PROGRAMUNIFORMMATRIX4FV, ProgramUniformMatrix4fv)                                              \
  X(DRAWELEMENTS, DrawElements) X(DRAWARRAYS, DrawArrays)                                          \
  X(DISPATCHCOMPUTE, DispatchCompute) X(MEMORYBARRIER, MemoryBarrier) X(FLUSH, Flush)              \
  X(CREATEQUERIES, CreateQueries) X(DELETEQUERIES, DeleteQueries) X(QUERYCOUNTER, QueryCounter)    \
  X(GETQUERYOBJECTUI64V, GetQueryObjectui64v)                                                      \
  X(FENCESYNC, FenceSync) X(CLIENTWAITSYNC, ClientWaitSync) X(DELETESYNC, DeleteSync)              \
  X(OBJECTLABEL, ObjectLabel) X(DEBUGMESSAGECALLBACK, DebugMessageCallback)
// clang-format on

namespace hybridrt::gl {

/// The OpenGL 4.5 core entry points of one context. Passed to whatever calls GL; there is no global instance.
struct Functions {
#define HRT_GL_MEMBER(TYPE, NAME) PFNGL##TYPE##PROC NAME = nullptr;
  HRT_GL_FUNCTIONS(HRT_GL_MEMBER)
#undef HRT_GL_MEMBER
};

/// Looks up every entry point with the context's own GetProcAddress; the context must be current. Throws Error(device)
/// naming the first one that is missing.
Functions load_functions(const std::function<void*(const char* name)>& get_proc_address);

/// Throws Error(device) if GL has recorded an error since the last call. A pass calls it at its end;
/// `where` names the pass.
void throw_on_error(const Functions& gl, const char* where);

}  // namespace hybridrt::gl
