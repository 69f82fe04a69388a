#pragma once
// Draws one picture after another by beams.

#include <memory>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// For interactive programs (engine "beams" or "preview"). Keeps memory from frame to frame, and
/// whatever a change leaves valid.
class FrameRenderer {
public:
    /// Throws InputError if beams cannot draw the scene.
    explicit FrameRenderer(const Scene& scene);
    ~FrameRenderer();
    FrameRenderer(FrameRenderer&&) noexcept;

    /// Changes the view: beams are grown anew (milliseconds).
    void look_from(const Camera& camera);
    /// The same, with the lights turned or moved. Wavelengths are kept, which may not suit lights
    /// of other kinds or colours.
    void look_from(const Camera& camera, const Lights& lights);
    /// Changes the lights: beams are kept and shaded anew, unless the lights' colours need other
    /// wavelengths.
    void light_with(const Lights& lights);
    /// Changes view, lights and settings; the stone must stay the same.
    void show(const Scene& scene);
    /// Limits a frame's processor time in milliseconds; 0: no limit. Depending on the last frame's
    /// time, beams that bring little are not split further: the picture depends on the machine, and
    /// its `remainder` grows. Guy & Soler (2004) call this the frame-rate limit.
    void keep_within(double milliseconds);
    /// Reports the progress of a frame, and may stop it: `draw` then throws Interrupted.
    void report_to(const Progress& progress);

    /// The picture is valid until the next call. Without `check`, `error_bound` is that of the last
    /// view checked in this light and with these settings, as a note says; NaN if there was none.
    const RenderResult& draw(bool check = false);
    /// Moves the last picture out.
    RenderResult take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Why beams cannot draw the scene, in words; empty if they can.
std::string refused_by_beams(const Scene& scene, const OpticalSetup& setup);
std::string refused_by_beams(const Scene& scene);

bool drawn_by_beams(const RenderSettings& settings);

}  // namespace culet
