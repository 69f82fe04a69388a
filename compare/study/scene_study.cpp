#include "compare/study/scene_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

#include "compare/study/picture_error.h"
#include "compare/study/study_advice.h"
#include "compare/study/study_clock.h"
#include "compare/study/study_design.h"
#include "compare/study/study_reference.h"
#include "compare/study/study_words.h"
#include "render/beams/frame_renderer.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_reference_share = 0.4, k_design_share = 0.65, k_search_share = 0.85;
// Shares of the budget for the first drawing of a setting, and of one that the study needs.
constexpr double k_row_share = 0.06, k_needed_share = 0.15;
// Settings whose first run took up to this factor longer than the front's are timed again: their
// median might be faster.
constexpr double k_perhaps_quicker = 1.3;
// A neighbour must be this much faster for the search to continue from it.
constexpr double k_gain = 0.97;

struct DrawnTimes {
    std::vector<double> cpu, wall;
};

StudyTime of_runs(std::vector<double> times) {
    std::sort(times.begin(), times.end());
    const std::size_t n = times.size();
    return {n % 2 == 1 ? times[n / 2] : 0.5 * (times[n / 2 - 1] + times[n / 2]), times.front(),
            times.back()};
}

// Without the beams' check against the reference renderer, because the study compares itself.
RenderResult drawn(const Scene& scene, const Progress& progress) {
    if (!drawn_by_beams(scene.settings)) return render(scene, progress);
    FrameRenderer frames(scene);
    frames.report_to(progress);
    return frames.draw(false);
}

RenderSettings settled_by(const RenderSettings& asked, const RenderStats& stats) {
    if (!stats.plan) return asked;
    RenderSettings settled = stats.plan->settings;
    settled.checked_pixels = settled.checked_samples = 0;
    return settled;
}

class SceneStudier {
public:
    SceneStudier(const Scene& scene, const SceneStudyOptions& options, const Progress& progress)
        : scene_(scene), clock_(options.budget_seconds, progress) {
        study_.options = options;
        std::vector<double>& tolerances = study_.options.tolerances;
        const double asked = scene.settings.tolerance > 0 ? scene.settings.tolerance : 0.01;
        if (std::find(tolerances.begin(), tolerances.end(), asked) == tolerances.end())
            tolerances.push_back(asked);
        std::sort(tolerances.rbegin(), tolerances.rend());
        study_.name = scene.stone.name;
        study_.asked = scene.settings;
        study_.scene_width = scene.camera.width;
        study_.scene_height = scene.camera.height;
        studied_.tolerance = asked;
    }

    SceneStudy study() {
        prepare();
        for (const StudyCandidate& candidate : study_design(studied_)) try_out(candidate);
        drawing_share_ = k_search_share;
        try_by_hand();
        search();
        time_again();
        study_.advice = advice_of(study_);
        study_.cpu_seconds = clock_.spent();
        return std::move(study_);
    }

private:
    void prepare();
    void try_out(const StudyCandidate& candidate);
    void time_once(const RenderSettings& settings, DrawnTimes& times);
    void try_by_hand();
    void search();
    void time_again();
    void update_front();
    bool may_be_on_front(const StudiedRender& render) const;
    Scene scene_with(const RenderSettings& settings) const {
        Scene scene = studied_.scene;
        scene.settings = settings;
        // Random paths independent of the reference's.
        scene.settings.seed = scene_.settings.seed + 2;
        scene.settings.spectral = false;
        return scene;
    }

    const Scene& scene_;
    StudyClock clock_;
    StudiedScene studied_;
    SceneStudy study_;
    std::optional<PictureMetric> metric_;
    std::vector<DrawnTimes> times_;  // of each render
    std::set<std::string> tried_;
    double drawing_share_ = k_design_share;  // of the budget: until when settings are tried
};

void SceneStudier::prepare() {
    SceneStudyOptions& options = study_.options;
    const double finest = options.tolerances.back();
    const int longer = std::max(scene_.camera.width, scene_.camera.height);
    studied_.scene = scene_;
    studied_.tolerances = options.tolerances;
    const int size =
        options.size > 0
            ? std::min(options.size, longer)
            : affordable_size(scene_, finest, clock_.share(0.75 * k_reference_share), clock_);
    studied_.scene.camera = resized(scene_.camera, size);
    study_.width = studied_.scene.camera.width;
    study_.height = studied_.scene.camera.height;
    study_.reference = study_reference(studied_.scene, finest,
                                       clock_.share(k_reference_share) - clock_.spent(), clock_);
    studied_.exact = study_.reference.stats;
    metric_.emplace(study_.reference.picture);
    Scene by_beams = studied_.scene;
    by_beams.settings = exact_settings(scene_, studied_.tolerance, k_node_counts.front());
    const std::string refused = refused_by_beams(by_beams);
    studied_.beams = refused.empty();
    if (!studied_.beams) study_.notes.push_back("engines beams and preview: " + refused);
}

// Draws and evaluates a setting that was not tried yet, if there is time.
void SceneStudier::try_out(const StudyCandidate& candidate) {
    const std::string key = key_of(studied_, candidate.settings);
    if (!tried_.insert(key).second) return;
    const auto leave_out = [&](const std::string& why) {
        study_.left_out.push_back(fmt::format("{} {} ({}): {}", candidate.sweep, candidate.setting,
                                              words_of(studied_, candidate.settings), why));
    };
    if (!candidate.needed && clock_.spent() > clock_.share(drawing_share_))
        return leave_out("not reached within the budget");
    const double allowed =
        clock_.share(candidate.automatic || candidate.needed ? k_needed_share : k_row_share);
    const Scene scene = scene_with(candidate.settings);
    RenderResult result;
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = clock_.spent();
    try {
        if (!clock_.within(allowed,
                           [&](const Progress& progress) { result = drawn(scene, progress); }))
            return leave_out(fmt::format("took over {:.3g} s", allowed));
    } catch (const InputError& error) {
        return leave_out(error.what());
    }
    DrawnTimes times;
    times.cpu.push_back(clock_.spent() - cpu);
    times.wall.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count());
    StudiedRender render;
    if (candidate.automatic) {
        // Everything that `render` does: the plan, its pictures, and their check.
        render.checked_cpu = times.cpu.front();
    }
    render.id = static_cast<int>(study_.renders.size());
    render.sweep = candidate.sweep;
    render.setting = candidate.setting;
    render.settled = settled_by(candidate.settings, result.stats);
    render.words = words_of(studied_, render.settled);
    render.automatic = candidate.automatic;
    render.settings = candidate.settings;
    render.stats = std::move(result.stats);
    render.error = metric_->error_of(result.picture);
    const double noise = study_.reference.noise.mean;
    render.claimed_error = std::max(render.error.mean, noise);
    render.at_noise = render.error.mean < 2 * noise;
    render.runs = 1;
    render.cpu = of_runs(times.cpu);
    render.wall = of_runs(times.wall);
    render.difference = metric_->difference(result.picture);
    render.picture = std::move(result.picture);
    study_.renders.push_back(std::move(render));
    times_.push_back(std::move(times));
    update_front();
    clock_.report();
}

// Draws once more, only for the time.
void SceneStudier::time_once(const RenderSettings& settings, DrawnTimes& times) {
    const Scene scene = scene_with(settings);
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = clock_.spent();
    clock_.within(std::numeric_limits<double>::infinity(),
                  [&](const Progress& progress) { drawn(scene, progress); });
    times.cpu.push_back(clock_.spent() - cpu);
    times.wall.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count());
}

// Releases the pictures of renders off the front.
void SceneStudier::update_front() {
    study_.front = front_of(study_);
    for (StudiedRender& render : study_.renders) {
        render.on_front =
            std::find(study_.front.begin(), study_.front.end(), render.id) != study_.front.end();
        if (may_be_on_front(render)) continue;
        render.picture = {};
        render.difference = {};
    }
}

// False when another is both more accurate and much faster.
bool SceneStudier::may_be_on_front(const StudiedRender& render) const {
    return std::none_of(study_.front.begin(), study_.front.end(), [&](int id) {
        const StudiedRender& rival = study_.render(id);
        return rival.claimed_error <= render.claimed_error &&
               k_perhaps_quicker * rival.cpu.median < render.cpu.median;
    });
}

// Draws what the plans chose, given directly, without the planning time.
void SceneStudier::try_by_hand() {
    std::vector<StudyCandidate> chosen;
    for (const StudiedRender& render : study_.renders) {
        if (render.automatic) chosen.push_back({"by hand", render.setting, render.settled});
    }
    for (const StudyCandidate& candidate : chosen) try_out(candidate);
}

// Goes from the cheapest known setting for each tolerance to cheaper ones that still meet it.
void SceneStudier::search() {
    for (const double tolerance : study_.options.tolerances) {
        for (;;) {
            const std::optional<int> at = cheapest_within(study_, tolerance);
            if (!at || clock_.spent() > clock_.share(drawing_share_)) break;
            const RenderSettings settings = study_.render(*at).settled;
            const RenderStats stats = study_.render(*at).stats;
            const double before = study_.render(*at).cpu.median;
            for (const StudyCandidate& neighbour : cheaper_neighbours(studied_, settings, stats)) {
                if (clock_.spent() > clock_.share(drawing_share_)) break;
                try_out(neighbour);
            }
            const std::optional<int> next = cheapest_within(study_, tolerance);
            if (!next || *next == *at || study_.render(*next).cpu.median > k_gain * before) break;
        }
    }
}

// In turn, so that other load on the machine affects all alike.
void SceneStudier::time_again() {
    std::vector<int> chosen;
    for (const StudiedRender& render : study_.renders) {
        if (render.automatic || may_be_on_front(render)) chosen.push_back(render.id);
    }
    for (int run = 1; run < study_.options.runs; ++run) {
        for (const int id : chosen) {
            StudiedRender& render = study_.renders[static_cast<std::size_t>(id)];
            if (clock_.spent() + render.cpu.median > clock_.share(1)) continue;
            DrawnTimes& times = times_[static_cast<std::size_t>(id)];
            time_once(render.settings, times);
            render.runs = static_cast<int>(times.cpu.size());
            render.cpu = of_runs(times.cpu);
            render.wall = of_runs(times.wall);
        }
    }
    update_front();
    // Renders that are new on the front may have lost their pictures.
    for (const int id : study_.front) {
        StudiedRender& render = study_.renders[static_cast<std::size_t>(id)];
        if (!render.picture.rgb.empty()) continue;
        clock_.within(std::numeric_limits<double>::infinity(), [&](const Progress& progress) {
            render.picture = drawn(scene_with(render.settled), progress).picture;
        });
        render.difference = metric_->difference(render.picture);
    }
}

}  // namespace

SceneStudy study_scene(const Scene& scene, const SceneStudyOptions& options,
                       const Progress& progress) {
    return SceneStudier(scene, options, progress).study();
}

}  // namespace culet
