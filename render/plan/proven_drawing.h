#pragma once
// Pictures as a plan proposes them, drawn anew where the proof finds them not near enough: by finer
// beams, then by the reference, and with more rays.

#include <optional>

#include "render/plan/proof.h"
#include "render/plan/scene_plan.h"
#include "render/render.h"

namespace culet {

struct ProvenPicture {
    RenderResult result;
    bool proven = false;     ///< within the tolerance
    bool misjudged = false;  ///< not for its beams: the plan left out more than it saw
};

class ProvenDrawing {
public:
    /// Both must outlive it.
    ProvenDrawing(const Scene& scene, const Progress& progress)
        : scene_(scene), drawn_(scene), progress_(progress) {}

    /// `once`: a single picture. `as_one`: a crystal's two waves go as one, and no finer drawing
    /// brings the second back.
    enum class Way { any, as_one, once };
    /// The nearest of at most five pictures, or of those that the scene's meter allows. Throws
    /// Interrupted, and OverAllowance where it allows none.
    ProvenPicture draw(ScenePlan plan, Prover& prover, Way way);

private:
    // How a picture is drawn that was not near enough.
    struct Next {
        RenderSettings settings;
        double price = 0;
        std::string note;
    };
    struct Tried {
        const RenderSettings& settings;
        double price;
        const RenderStats& stats;
        const Proof& proof;
    };
    struct SoFar {
        std::optional<RenderResult> best;
        std::vector<std::string> notes;
        ProvenPicture done;
    };
    void draw_until_proven(ScenePlan& plan, Prover& prover, Way way, SoFar& so_far);
    RenderResult draw_with(const RenderSettings& settings);
    void find_causes(BeamProposal& beams, const Prover& prover, const RenderSettings& settings,
                     double price) const;
    std::optional<Next> next(ScenePlan& plan, const Tried& tried, Way way, bool last) const;
    std::optional<Next> finer_beams_than(ScenePlan& plan, const Tried& tried) const;
    Next more_rays(const ScenePlan& plan, const Tried& tried, double room) const;

    const Scene& scene_;
    Scene drawn_;
    const Progress& progress_;
    std::optional<FrameRenderer> frames_;
    std::optional<BeamProposal> learned_;  // from pictures that were not near enough
};

void add_plan(const ScenePlan& plan, RenderStats& stats);
/// Of all that a picture took.
double seconds_of(const RenderStats& stats);

}  // namespace culet
