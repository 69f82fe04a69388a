#pragma once
// What a picture's choices are off by, each alone: the truth's own rays at pixels of its check,
// drawn once more with that choice. A pilot of even pixels may miss the few that bring most; these
// were chosen where pictures are off.

#include "render/planner/error_estimate.h"

namespace culet {

class CausePilot {
public:
    /// `scene`: with everything on; `drawn`: the settings of a picture. Scene and progress must
    /// outlive it. Nothing is drawn yet.
    CausePilot(const Scene& scene, const RenderSettings& drawn, CheckedSample sample,
               const Progress& progress);

    /// The effects that the picture leaves out.
    double without_effects();
    /// Paths cut at this weight, with the picture's effects.
    double at_cut(double weight);
    /// So few wavelengths, with the picture's effects.
    double at_wavelengths(const std::vector<double>& nm);
    /// What the truth's few rays are off by: what less is off by, wavelengths and effects cannot
    /// tell.
    double noise() const { return sample_.noise; }
    /// Below this weight the truth's own paths are cut; so many wavelengths are the truth's.
    double least_cut() const { return sample_.limits.cut_weight; }
    int wavelengths() const { return sample_.nodes; }

private:
    std::vector<Rgb> draw(const Scene& scene, const PathLimits& limits) const;
    // Mean difference over the truth's mean.
    double between(const std::vector<Rgb>& some, const std::vector<Rgb>& others) const;
    double beyond_noise(double difference) const;
    const std::vector<Rgb>& with_drawn_effects();

    const Scene& scene_;
    Scene without_;  // effects that the picture leaves out
    CheckedSample sample_;
    const Progress& progress_;
    std::optional<std::vector<Rgb>> seen_;  // without these effects
};

}  // namespace culet
