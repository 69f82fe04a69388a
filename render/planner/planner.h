#pragma once
// From a scene and a tolerance to a picture whose error is known, in this folder:
//
// - `planner`: which effects a picture needs, by what is known beforehand (`known_effects`), then
//   by one pilot an effect, the scene with and without it (`effect_pilots`, `pilot_picture`);
//   `explain` tells it.
// - `refinement`: pictures of these effects from coarse to fine (`refinement_levels`), each held
//   against the truth until one is near enough.
// - `error_estimate`: the truth is the reference with everything on, at few pixels that
//   `check_pixels` and, for small bright lights, `light_edge_scan` choose; a mean with three
//   standard errors is the bound.
// - `time_budget`: where there is no tolerance, as fine as a given amount of counted work allows.
// - `policy.h`: the constants.

#include <chrono>
#include <initializer_list>
#include <limits>
#include <optional>

#include "render/colour/colour_error.h"
#include "render/engine/scene_plan.h"
#include "render/planner/error_estimate.h"
#include "render/planner/pilot_picture.h"
#include "render/setup/optical_setup.h"

namespace culet {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* k_merged_waves = "the two waves are merged";
constexpr const char* k_same_light = "the light is the same from everywhere: nothing changes";

/// Whether `render` first draws a crystal's two waves merged: what that is off by, a pilot of few
/// rays shows as far too much, because it shifts light within the pixel.
bool tried_with_merged_waves(const Scene& scene);

/// Why effects are on or off, as far as that is known without drawing: the lines of `plan`.
void say_what_is_known(const Scene& scene, ScenePlan& plan);

class Planner {
public:
    /// Likely: effects go that are likely to change little enough. Surely: only those that are sure
    /// to change nothing; a picture has shown that few pixels misjudge the scene.
    enum class Leave { likely, surely };
    /// `merged_waves`: a crystal's two waves are merged, which only the finished picture can show
    /// to be near enough. `progress` is told 0, and may stop it; it must outlive the planner.
    Planner(const Scene& whole, const Progress& progress, bool merged_waves = false,
            Leave leave = Leave::likely);
    /// For a picture: where the coarsest costs no more than weighing effects, none is weighed, and
    /// none left out but what is sure to change nothing.
    ScenePlan run();
    /// For people who want to know: all are weighed, those too that the scene switches off.
    ScenePlan run_to_explain(bool everything);

    /// Holds pictures against the truth; none where there was no pilot. After `run`.
    std::optional<ErrorEstimator> take_estimator() { return std::move(estimator_); }
    /// Before all else: of the same scene, whose drawings count.
    void give_estimator(std::optional<ErrorEstimator> estimator) {
        estimator_ = std::move(estimator);
    }

private:
    // With an effect and without, at the pilot's pixels, and the price of a pixel of each.
    struct Pilot {
        PilotDrawing with, without;
        ColourError error;
        double price_with = 0, price_without = 0;
    };
    PlanItem& item(Effects effect) { return plan_.items[static_cast<std::size_t>(effect)]; }
    bool on(Effects effect) const { return plan_.items[static_cast<std::size_t>(effect)].on; }
    void leave_out(Effects effect, std::string why);
    Scene with_effects(std::initializer_list<Effects> less) const;
    Scene piloted(std::initializer_list<Effects> less = {}) const;
    PathLimits limits() const;
    PilotDrawing draw(const Scene& scene) const;
    double price_of(const Scene& scene, const PilotDrawing& drawing) const;
    Pilot pilot(const Scene& with, const Scene& without, std::optional<PilotDrawing> drawn) const;
    void write(const Pilot& pilot, PlanItem& line) const;

    ScenePlan run(bool weigh);
    void find_pixels();
    void drop_what_changes_nothing();
    bool costs_less_than_pilots();
    void weigh_effects();
    void try_without(Effects effect, double share);
    ColourError colours_apart() const;
    void decide(PlanItem& line, const ColourError& error, double bound, double share);
    void bound_coherence();
    void bound_depth();
    void choose_first_picture();
    void estimate_times();
    void measure_what_the_scene_forbids();

    Scene scene_;                // of one window
    const RenderSettings user_;  // as the scene has them
    const Progress& progress_;
    const double tolerance_;
    const Leave leave_;
    const int rays_;  // of a pilot's pixel
    ScenePlan plan_;
    StonePixels pixels_;                       // of the pilots
    std::optional<ErrorEstimator> estimator_;  // of others
    bool branches_ = false;                    // trees of light paths double
    double left_out_ = 0;                      // what effects that are left out are likely off by
    PilotDrawing first_;                       // with the effects that are on, without dispersion
    double whole_price_ = 0;                   // of its pixel, with everything on
    double machine_ = 1;                       // nanoseconds of this one over those of price.h
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace culet
