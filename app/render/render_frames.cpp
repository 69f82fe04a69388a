#include "app/render/render_frames.h"

#include <fmt/format.h>

#include <filesystem>
#include <numbers>

#include "app/program/scratch_folder.h"
#include "app/program/terminal.h"
#include "app/render/movie.h"
#include "render/engine/engine.h"
#include "render/render.h"
#include "render/scene/turntable.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"

namespace culet {

namespace {

namespace fs = std::filesystem;

PictureOutput output_of(const Frames& frames, int frame, const std::string& exposure,
                        const Scene& scene) {
    PictureOutput output(frame_name(frames.out, frame), frames.spectral);
    output.look_as(exposure, frames.tonemap, scene);
    return output;
}

}  // namespace

std::string frame_name(const std::string& pattern, int frame) {
    const std::size_t last = pattern.rfind('#');
    if (last == std::string::npos) return pattern;
    std::size_t first = last;
    while (first > 0 && pattern[first - 1] == '#') --first;
    return pattern.substr(0, first) + fmt::format("{:0{}}", frame + 1, last - first + 1) +
           pattern.substr(last + 1);
}

void require_frames(const Frames& frames) {
    if (is_movie(frames.out)) {
        require_writable(frames.out);
        require_ffmpeg(frames.out);
        return;
    }
    const std::string name = fs::path(frames.out).filename().string();
    if (name.find('#') == std::string::npos)
        throw InputError(
            "--frames writes many pictures: say where their numbers go, -o frame-####.png, or name "
            "a film, -o turn.mp4");
    // All frames have the same extension and folder as the first.
    PictureOutput(frame_name(frames.out, 0), frames.spectral);
}

RenderResult draw_frames(const Frames& frames, const Scene& scene,
                         const std::function<RenderResult(const Scene&)>& first, bool quiet) {
    if (is_movie(frames.out)) {
        const ScratchFolder folder;
        Frames pictures = frames;
        pictures.out = (folder.path() / "frame-#####.png").string();
        RenderResult result = draw_frames(pictures, scene, first, quiet);
        write_movie(folder.path(), frames.out);
        return result;
    }
    const double step = frames.turn_deg * std::numbers::pi / 180 / frames.count;
    std::string exposure = frames.exposure;
    RenderResult kept;
    ScenePlan plan;
    for (int frame = 0; frame < frames.count; ++frame) {
        const Scene now = frame == 0 ? scene : turned(scene, step * frame);
        const PictureOutput output = output_of(frames, frame, exposure, now);
        RenderResult result;
        if (frame == 0) {
            result = first(now);
            plan = plan_drawn(scene, result.stats);
            // A constant exposure, so that the turning stone does not make the light flicker.
            exposure = fmt::format("{}", output.exposure_of(result.picture));
        } else {
            const std::string what = fmt::format("frame {} of {}", frame + 1, frames.count);
            result = render_as_planned(now, plan, progress_line(what, quiet));
        }
        output.write(result.picture, {{"culet:frame", std::to_string(frame + 1)}});
        if (frame == 0) {
            result.picture = {};
            kept = std::move(result);
        }
    }
    if (frames.count > 1 && engine_of(plan.settings).approaches_truth()) {
        kept.stats.notes.push_back(
            fmt::format("settings and error bound are those of the first of {} frames, which was "
                        "planned and checked for all",
                        frames.count));
    }
    return kept;
}

}  // namespace culet
