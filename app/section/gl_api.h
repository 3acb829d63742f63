// The OpenGL 3.3 core functions that the renderer calls, as a table that each back end fills
// through its own GetProcAddress. (libepoxy resolves through GLX or EGL and aborts under OSMesa.)
#pragma once

#include <GL/glcorearb.h>

#include "engine/base/status.h"

#include <stdbool.h>

// X(middle part of the pointer's type, name of the function without gl)
#define SB_GL_FUNCTIONS(X)                                                                         \
  X(ACTIVETEXTURE, ActiveTexture)                                                                  \
  X(ATTACHSHADER, AttachShader)                                                                    \
  X(BINDBUFFER, BindBuffer)                                                                        \
  X(BINDFRAMEBUFFER, BindFramebuffer)                                                              \
  X(BINDRENDERBUFFER, BindRenderbuffer)                                                            \
  X(BINDTEXTURE, BindTexture)                                                                      \
  X(BINDVERTEXARRAY, BindVertexArray)                                                              \
  X(BLENDFUNC, BlendFunc)                                                                          \
  X(BUFFERDATA, BufferData)                                                                        \
  X(BUFFERSUBDATA, BufferSubData)                                                                  \
  X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                                \
  X(CLEAR, Clear)                                                                                  \
  X(CLEARCOLOR, ClearColor)                                                                        \
  X(COMPILESHADER, CompileShader)                                                                  \
  X(CREATEPROGRAM, CreateProgram)                                                                  \
  X(CREATESHADER, CreateShader)                                                                    \
  X(DELETEBUFFERS, DeleteBuffers)                                                                  \
  X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                        \
  X(DELETEPROGRAM, DeleteProgram)                                                                  \
  X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                      \
  X(DELETESHADER, DeleteShader)                                                                    \
  X(DELETETEXTURES, DeleteTextures)                                                                \
  X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                        \
  X(DISABLE, Disable)                                                                              \
  X(DRAWARRAYS, DrawArrays)                                                                        \
  X(ENABLE, Enable)                                                                                \
  X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                              \
  X(FINISH, Finish)                                                                                \
  X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                              \
  X(GENBUFFERS, GenBuffers)                                                                        \
  X(GENFRAMEBUFFERS, GenFramebuffers)                                                              \
  X(GENRENDERBUFFERS, GenRenderbuffers)                                                            \
  X(GENTEXTURES, GenTextures)                                                                      \
  X(GENVERTEXARRAYS, GenVertexArrays)                                                              \
  X(GETERROR, GetError)                                                                            \
  X(GETINTEGERV, GetIntegerv)                                                                      \
  X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                          \
  X(GETPROGRAMIV, GetProgramiv)                                                                    \
  X(GETSHADERINFOLOG, GetShaderInfoLog)                                                            \
  X(GETSHADERIV, GetShaderiv)                                                                      \
  X(GETSTRING, GetString)                                                                          \
  X(GETUNIFORMLOCATION, GetUniformLocation)                                                        \
  X(LINKPROGRAM, LinkProgram)                                                                      \
  X(PIXELSTOREI, PixelStorei)                                                                      \
  X(READPIXELS, ReadPixels)                                                                        \
  X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                      \
  X(SCISSOR, Scissor)                                                                              \
  X(SHADERSOURCE, ShaderSource)                                                                    \
  X(TEXIMAGE2D, TexImage2D)                                                                        \
  X(TEXPARAMETERI, TexParameteri)                                                                  \
  X(TEXSUBIMAGE2D, TexSubImage2D)                                                                  \
  X(UNIFORM1F, Uniform1f)                                                                          \
  X(UNIFORM1I, Uniform1i)                                                                          \
  X(UNIFORM2F, Uniform2f)                                                                          \
  X(UNIFORM4F, Uniform4f)                                                                          \
  X(USEPROGRAM, UseProgram)                                                                        \
  X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                      \
  X(VIEWPORT, Viewport)

// The table: one member for each function, such as `ActiveTexture`. All functions belong to the
// context from which they were loaded, and to its thread.
typedef struct {
#define SB_GL_MEMBER(type, name) PFNGL##type##PROC name;
  SB_GL_FUNCTIONS(SB_GL_MEMBER)
#undef SB_GL_MEMBER
} SbGlApi;

// Returns the address of the GL function `name` ("glClear"); NULL: there is none.
typedef void *(*SbGlGetProc)(void *data, const char *name);

// Fills the table by calls of get_proc(data, name), with a context current. Returns false if a
// function is missing; *missing is then its name (static).
SB_CHECKED bool sb_gl_api_load(SbGlApi *api, SbGlGetProc get_proc, void *data,
                               const char **missing);
