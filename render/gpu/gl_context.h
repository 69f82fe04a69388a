#pragma once
// A GL driver without a window: OpenGL ES 3 by EGL.

#include <string>

#include "render/gpu/gl_functions.h"

namespace culet {

/// Current in the thread that made it, as long as it lives. A real GPU's driver is preferred to one
/// that computes on the processor.
class GlContext {
public:
    /// Throws InputError where there is no driver, with what to install.
    GlContext();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    const GlFunctions& gl() const { return gl_; }
    /// The driver's name of itself (GL_RENDERER), printable ASCII, at most 100 characters.
    const std::string& renderer() const { return renderer_; }

private:
    GlFunctions gl_;
    std::string renderer_;
    void *display_ = nullptr, *context_ = nullptr;
};

}  // namespace culet
