#pragma once
// A GPU program at work: sums of samples in float framebuffers.

#include <memory>
#include <vector>

#include "render/gpu/gl_context.h"
#include "render/gpu/gpu_program.h"

namespace culet {

/// Of one picture's size; needs its context, which must be current. Throws InputError for what the
/// driver cannot do: a size, a number of uniforms, float framebuffers.
class GpuCanvas {
public:
    GpuCanvas(const GlContext& context, const GpuProgram& program, int width, int height,
              bool balance);
    ~GpuCanvas();
    GpuCanvas(const GpuCanvas&) = delete;
    GpuCanvas& operator=(const GpuCanvas&) = delete;

    void set(const std::vector<GpuUniform>& uniforms);
    /// The next draw begins a new sum.
    void start_anew() { keep_ = false; }
    /// Adds what the program draws with its uniforms as they are, some rows at a time; `goes_on` is
    /// asked before each. False when it said no: the sum is then of no use.
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
    /// Times that one draw asks to go on.
    int parts() const { return (height_ + rows_ - 1) / rows_; }

    /// RGBA of each pixel, rows from the top. `target`: 0 the sum, 1 the balance, 2 the length.
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
