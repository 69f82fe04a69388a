#pragma once
// From a scene and a tolerance to a picture with a known error. In this folder:
//
// - `planner`: decides which effects are needed, from what is known beforehand (`known_effects`),
//   then by pilots (small trial pictures) with and without each effect (`effect_pilots`,
//   `pilot_picture`). `explain` reports it.
// - `refinement`: draws pictures from coarse to fine (`refinement_levels`) until a check passes.
// - `error_estimate`: compares a picture with the reference (everything on) at pixels chosen by
//   `check_pixels` and, for small bright lights, `light_edge_scan`.
// - `time_budget`: without a tolerance, draws as finely as a given amount of work allows.
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

/// Whether `render` first tries a crystal's two waves merged. A pilot of few rays overrates that
/// error by far, because merging shifts light within the pixel.
bool tried_with_merged_waves(const Scene& scene);

/// Fills in why effects are on or off, as far as that is known without drawing.
void explain_known_effects(const Scene& scene, ScenePlan& plan);

class Planner {
public:
    /// likely: omit effects that probably change little enough. surely: omit only those that
    /// certainly change nothing, after a picture has shown that the pilot misjudged the scene.
    enum class Leave { likely, surely };
    /// `merged_waves`: merge a crystal's two waves; only the finished picture shows whether that is
    /// close enough. `progress` receives 0 and may stop it; it must outlive the planner.
    Planner(const Scene& whole, const Progress& progress, bool merged_waves = false,
            Leave leave = Leave::likely);
    /// Plans a picture. If the coarsest picture costs no more than weighing effects, only effects
    /// that certainly change nothing are omitted.
    ScenePlan run();
    /// Plans with all effects weighed; with `everything` also those that the scene switches off.
    ScenePlan run_to_explain(bool everything);

    /// The estimator for this scene's pictures; none if there was no pilot. Call after `run`.
    std::optional<ErrorEstimator> take_estimator() { return std::move(estimator_); }
    /// Reuses an estimator of the same scene, with what it has drawn. Call before `run`.
    void give_estimator(std::optional<ErrorEstimator> estimator) {
        estimator_ = std::move(estimator);
    }

private:
    // The pilot's pixels with and without an effect, and the price per pixel of each.
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
    void drop_exact_effects();
    bool costs_less_than_pilots();
    void weigh_effects();
    void try_without(Effects effect, double share);
    ColourError dispersion_error() const;
    void decide(PlanItem& line, const ColourError& error, double bound, double share);
    void bound_coherence();
    void bound_depth();
    void choose_first_picture();
    void estimate_times();
    void measure_disabled_effects();

    Scene scene_;                // of one window
    const RenderSettings user_;  // as in the scene
    const Progress& progress_;
    const double tolerance_;
    const Leave leave_;
    const int rays_;  // per pixel of a pilot
    ScenePlan plan_;
    StonePixels pixels_;                       // of the pilots
    std::optional<ErrorEstimator> estimator_;  // uses pixels other than the pilots'
    bool branches_ = false;                    // light paths branch into trees
    double left_out_ = 0;                      // likely error of all effects left out
    PilotDrawing first_;                       // with the effects that are on, without dispersion
    double whole_price_ = 0;                   // of one of its pixels, with everything on
    double machine_ = 1;                       // this machine's nanoseconds over those of price.h
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace culet
