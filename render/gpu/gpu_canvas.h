#pragma once
// Runs a GPU program: sums samples in float framebuffers.

#include <memory>
#include <vector>

#include "render/gpu/gl_context.h"
#include "render/gpu/gpu_program.h"

namespace culet {

/// For pictures of one size. Its context must be current. Throws InputError if the driver lacks the
/// size, the number of uniforms or float framebuffers.
class GpuCanvas {
public:
    GpuCanvas(const GlContext& context, const GpuProgram& program, int width, int height,
              bool balance);
    ~GpuCanvas();
    GpuCanvas(const GpuCanvas&) = delete;
    GpuCanvas& operator=(const GpuCanvas&) = delete;

    void set(const std::vector<GpuUniform>& uniforms);
    /// Makes the next draw begin a new sum.
    void start_anew() { keep_ = false; }
    /// Adds one sample drawn with the current uniforms, some rows at a time; asks `goes_on` before
    /// each part. Returns false, with a useless sum, if that said no.
    template <class GoesOn>
    bool draw(GoesOn&& goes_on) {
        begin();
        for (int row = 0; row < height_; row += rows_) {
            if (!goes_on()) return false;
            draw_rows(row);
        }
        end();
        return true;
    }
    /// Number of parts of one draw.
    int parts() const { return (height_ + rows_ - 1) / rows_; }

    /// RGBA of each pixel, top row first. `target`: 0 the sum, 1 the balance, 2 the length.
    std::vector<float> read(int target) const;

private:
    void begin();
    void draw_rows(int row);
    void end();

    struct Objects;
    std::unique_ptr<Objects> objects_;
    int width_, height_, rows_;
    bool keep_ = false;
};

}  // namespace culet
