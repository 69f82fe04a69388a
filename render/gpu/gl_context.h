#pragma once
// An OpenGL ES 3 context by EGL, without a window.

#include <string>

#include "render/gpu/gl_functions.h"

namespace culet {

/// Current in the thread that made it, for its lifetime. Prefers a real GPU to a software driver.
class GlContext {
public:
    /// Throws InputError, saying what to install, if there is no driver.
    GlContext();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    const GlFunctions& gl() const { return gl_; }
    /// GL_RENDERER as printable ASCII, at most 100 characters.
    const std::string& renderer() const { return renderer_; }

private:
    GlFunctions gl_;
    std::string renderer_;
    void *display_ = nullptr, *context_ = nullptr;
};

}  // namespace culet
