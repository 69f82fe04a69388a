#pragma once
// Pictures by beams, one after the other.

#include <memory>

#include "render/engine/render_result.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

/// Frame after frame by beams (engine "beams" or "preview"), for programs that draw while a person
/// watches: what is kept from frame to frame is memory and whatever the changes left valid.
class FrameRenderer {
public:
    /// Throws InputError where the scene cannot be drawn by beams.
    explicit FrameRenderer(const Scene& scene);
    ~FrameRenderer();
    FrameRenderer(FrameRenderer&&) noexcept;

    /// Another view: beams are grown anew (milliseconds).
    void look_from(const Camera& camera);
    /// The same, with the lights turned or moved: the wavelengths stay, which other kinds or
    /// colours of lights may not.
    void look_from(const Camera& camera, const Lights& lights);
    /// Other lights: the beams stay, and are only shaded anew, unless the lights' colours call for
    /// other wavelengths.
    void light_with(const Lights& lights);
    /// Another view, other lights and other settings: only the stone, which must be the same,
    /// stays.
    void show(const Scene& scene);
    /// Milliseconds of processor time that a frame may take; 0: no limit. Beams that bring little
    /// are then split no further, as much as the last frame's time asks for: the picture depends on
    /// the machine, and its `remainder` grows. Guy & Soler (2004) call it the frame-rate limit.
    void keep_within(double milliseconds);
    /// Told how far a frame is; may stop it, and `draw` then throws Interrupted.
    void report_to(const Progress& progress);

    /// The picture stays valid until the next call. Without `check` no pixels are compared with the
    /// reference: `error_bound` is that of the last view that was checked, in this light and with
    /// these settings, as a note says; NaN where none was.
    const RenderResult& draw(bool check = false);
    /// What was drawn last, with its memory.
    RenderResult take();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Why beams cannot draw this, in words; empty: they can.
std::string refused_by_beams(const Scene& scene, const OpticalSetup& setup);
std::string refused_by_beams(const Scene& scene);

bool drawn_by_beams(const RenderSettings& settings);

}  // namespace culet
