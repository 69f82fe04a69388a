#pragma once
// How a plan is made: what is known beforehand, then pilots of the scene with this or that left
// out.

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "render/colour_error.h"
#include "render/plan.h"
#include "render/plan/beam_proposal.h"
#include "render/plan/pilot_picture.h"
#include "render/plan/price.h"
#include "render/plan/proof.h"
#include "render/plan/scene_plan.h"

namespace culet {

// How the tolerance is shared out. Errors of causes of their own add up as squares do: what all
// effects that are left out are likely off by.
constexpr double k_share_of_cut = 0.2, k_share_of_effects = 0.5, k_share_of_wavelengths = 0.5;
// Effects that cost next to nothing go only where they change next to nothing.
constexpr double k_share_of_cheap = 0.05;
// Rays of a pilot in each pixel; behind a lens. A mean over so few differs by more than one over
// the pixel.
constexpr int k_pilot_rays = 4, k_spectral_rays = 4, k_other_spectral_rays = 5, k_lens_rays = 16;
constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* k_as_one = "the two waves go as one";
constexpr const char* k_by_its_size = "it bends colours apart by little";
constexpr const char* k_same_light = "the light is the same from everywhere: nothing changes";

std::vector<double> even_wavelengths(int count);
/// Wavelengths that a pilot holds fewer against.
int finest_of_pilot(double tolerance);
/// Turns that the rays of a pixel take with so many wavelengths: four at a time bring nearly as
/// much as all of them, and each at least twice.
int turns_for(int rays, int wavelengths);

/// Whether `render` first draws a crystal's two waves as one: what that is off by, a pilot of few
/// rays shows as far too much, because it shifts light within the pixel.
bool tried_as_one_wave(const Scene& scene);

/// Two drawings of the same pixels by other rays.
struct TwoDrawings {
    PilotDrawing one, other;
};

class Planner {
public:
    /// Likely: effects go that are likely to change little enough. Surely: only those that are sure
    /// to change nothing; a picture has shown that few pixels misjudge the scene.
    enum class Leave { likely, surely };
    /// `one_wave`: a crystal's two waves are to go as one, which only the finished picture can show
    /// to be near enough. `progress` is told 0, and may stop it; it must outlive the planner.
    Planner(const Scene& whole, const Progress& progress, bool one_wave = false,
            Leave leave = Leave::likely);
    /// `everything`: what the scene switches off is measured too.
    ScenePlan run(bool everything = false);
    /// Before `run`: beams that are likely near enough as far as one ray in each of a few pixels
    /// and what such choices usually cost tell, where they are about as cheap as looking closer. No
    /// effect was weighed, and no bound is known but the finished picture's.
    std::optional<ScenePlan> at_a_glance();

    /// Holds pictures against the truth; none where there was no pilot. After `run`.
    std::optional<Prover> take_prover() { return std::move(prover_); }
    /// The same, kept. After `at_a_glance`.
    Prover* prover() { return prover_ ? &*prover_ : nullptr; }
    /// Before all else: of the same scene, whose drawings count.
    void give_prover(std::optional<Prover> prover) { prover_ = std::move(prover); }

private:
    PlanItem& item(Effects effect) { return plan_.items[static_cast<std::size_t>(effect)]; }
    bool on(Effects effect) const { return plan_.items[static_cast<std::size_t>(effect)].on; }

    // The scene with the effects that are on, less one.
    Scene with_effects(bool dispersion, std::optional<Effects> without = {}) const;
    Scene at_pilot_wavelengths(Scene scene) const;
    /// A whole spectrum, where one is called for: a single way through the stone carries it.
    Scene at_glance_wavelengths(Scene scene) const;
    PilotDrawing draw(const Scene& scene, int samples) const;
    /// Twice, independently, at half the pixels: many wavelengths are dear.
    TwoDrawings draw_spectra(const Scene& scene) const;
    /// Whether something that is likely to be off by so much may be left out, with all that is:
    /// `share` of the tolerance at most.
    bool may_go(double bound, double likely, double share) const;
    void leave_out(double bound, double likely);
    /// The largest weight that is tried for what may be let go; the others fall by `k_cut_step`.
    double coarsest_cut() const { return std::min(0.3, 9 * tolerance_); }
    static constexpr double k_cut_step = 3;
    PathLimits limits(double cut) const;
    PathLimits limits_of_picture() const;
    // Of one eye ray.
    PathWork work_of(const Scene& scene, const PilotDrawing& drawing, int samples) const;

    void look();
    void finish();
    void say_what_is_known();
    void settle_without_pilot();
    void choose_pixels();
    bool proposes_at_a_glance();
    ScenePlan plan_of_glance();
    std::vector<WavelengthChoice> usual_wavelengths() const;
    BeamProposal beams_of(const Plan& plan, const PathWork& work) const;
    BeamProposal usual_beams(const Scene& scene) const;
    void choose_cut();
    void choose_effects();
    void try_without(Effects effect, double share);
    void bound_coherence();
    void measure_what_the_scene_forbids();
    void choose_wavelengths();
    void choose_engine_and_samples();
    void drop_what_changes_nothing();
    /// The fewest of `counts` that serve, held against `fine`, a drawing of `pilot` at that level.
    void settle_wavelengths(Scene pilot, const std::vector<int>& counts, std::size_t level,
                            const TwoDrawings& fine);
    void take(const CutChoice& cut);
    void take(const WavelengthChoice& set);
    int samples_for(double room) const;
    /// The reference's settings, and its price.
    double choose_reference(double room);
    double choose_beams();
    void bring_polarization_back(BeamProposal& proposal, double room);
    int choose_pupil(double room);
    void measure_noise();
    void bound_depth();
    void estimate_times();
    void add_resolutions();

    Scene scene_;                // of one window
    const RenderSettings user_;  // as the scene has them
    const Progress& progress_;
    double tolerance_;
    bool one_wave_;
    Leave leave_;
    ScenePlan plan_;
    bool looked_ = false, at_a_glance_ = false;
    double seconds_looking_ = 0;
    PilotDrawing glance_;  // one ray a pixel, without dispersion
    PathWork glance_work_;
    double pilot_ns_ = 0;           // about what looking closer will cost
    StonePixels pixels_;            // of the pilots
    std::optional<Prover> prover_;  // of others
    bool branches_ = false;         // trees of light paths double
    double cut_ = 0;
    double spent_ = 0;     // of the tolerance, by bounds
    double left_out_ = 0;  // what effects that are left out are likely off by
    std::vector<CutChoice> cuts_;
    // As the scene says, or to choose from.
    std::vector<WavelengthChoice> sets_{WavelengthChoice{}};
    PilotDrawing first_;     // with the effects that are on, without dispersion
    PathWork work_, whole_;  // of one of its eye rays; the same with everything on
    double cut_error_ = 0, cut_bound_ = 0, cut_delta_e_ = 0;
    double wavelength_bound_ = 0, wavelength_delta_e_ = 0;
    bool spectrum_ = false;  // the wavelengths were chosen
    double whole_bands_ = 1, bands_ = 1;
    bool dispersed_ = false;  // wavelengths go ways of their own
    // What a pixel is off by for its few rays.
    struct Noise {
        double rays = 4, radiance = 0, delta_e = 0;
        // Of rays: N^-0.75 on a grid where edges cross the pixel, N^-0.5 where chance decides.
        double power = 0.7;

        double at(double count) const;
    } noise_;
    double machine_ = 1;  // nanoseconds of this one over those of price.h
};

}  // namespace culet
