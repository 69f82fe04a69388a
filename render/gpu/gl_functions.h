#pragma once
// The OpenGL ES 3 functions in use. They are looked up at run time, so that the program starts
// without a driver.

#include <GLES3/gl3.h>

namespace culet {

// A table that clang-format would reflow.
// clang-format off
#define CULET_GL_FUNCTIONS(ONE)                                                                  \
    ONE(ActiveTexture) ONE(AttachShader) ONE(BindFramebuffer) ONE(BindTexture)                   \
    ONE(BindVertexArray) ONE(CheckFramebufferStatus) ONE(CompileShader) ONE(CreateProgram)       \
    ONE(CreateShader) ONE(DeleteFramebuffers) ONE(DeleteProgram) ONE(DeleteShader)               \
    ONE(DeleteTextures) ONE(DeleteVertexArrays) ONE(DrawArrays) ONE(DrawBuffers) ONE(Enable)     \
    ONE(Finish) ONE(FramebufferTexture2D) ONE(GenFramebuffers) ONE(GenTextures)                  \
    ONE(GenVertexArrays) ONE(GetError) ONE(GetIntegerv) ONE(GetProgramInfoLog)                   \
    ONE(GetProgramiv) ONE(GetShaderInfoLog) ONE(GetShaderiv) ONE(GetString)                      \
    ONE(GetUniformLocation) ONE(LinkProgram) ONE(ReadBuffer) ONE(ReadPixels) ONE(Scissor)        \
    ONE(ShaderSource) ONE(TexImage2D) ONE(TexParameteri) ONE(Uniform1fv) ONE(Uniform1iv)         \
    ONE(Uniform2fv) ONE(Uniform3fv) ONE(Uniform4fv) ONE(UniformMatrix3fv) ONE(UseProgram)        \
    ONE(Viewport)
// clang-format on

/// gl.Viewport(...) is glViewport(...).
struct GlFunctions {
#define CULET_GL_FUNCTION(name) decltype(&::gl##name) name = nullptr;
    CULET_GL_FUNCTIONS(CULET_GL_FUNCTION)
#undef CULET_GL_FUNCTION
};

}  // namespace culet
