#pragma once
// The cheapest beams that are likely near enough, where light has one way through the stone.
//
// What they are off by has four causes: light that is cut, so few wavelengths, effects left out,
// and borders and colours of regions. Causes of their own add up as squares do. The first three a
// pilot has seen; of the last there is a model, measured on 15 scenes at three sizes, which is
// right within a factor of three or so. A picture that was held against the truth says more.

#include <vector>

#include "render/scene.h"

namespace culet {

/// What a choice is likely off by (errors as in scene_plan.h), and its bound.
struct CutChoice {
    double weight = 0, error = 0, bound = 0, bound_delta_e = 0;
};
struct WavelengthChoice {
    int count = 0;  ///< 0: as the scene says
    double error = 0, bound = 0, bound_delta_e = 0;
};

/// Of one picture by beams.
struct ProposedBeams {
    bool preview = false;
    double tolerance = 0;  ///< of the borders (RenderSettings::tolerance)
    CutChoice cut;
    WavelengthChoice wavelengths;
    double borders = 0;   ///< what they are likely off by
    double error = 0;     ///< with all causes
    double price_ns = 0;  ///< price.h

    void apply_to(RenderSettings& settings) const;
};

class BeamProposal {
public:
    std::vector<CutChoice> cuts;         ///< coarsest first, at least one
    std::vector<WavelengthChoice> sets;  ///< at least one
    double effects = 0;                  ///< of those that are left out
    double pixels = 0, events_per_ray = 1;
    double views = 1;        ///< points of the pupil
    int bands = 1;           ///< trees, where the scene says the wavelengths
    bool dispersed = false;  ///< each wavelength has a tree
    bool polarised = true;
    bool previews = true, borders_are_open = true;

    /// The cheapest that is likely off by `room` at most, of those that cost more than `over_ns`
    /// and at most `most_ns`; if none is, of these the one that is likely off least. A price of 0:
    /// there is none.
    ProposedBeams cheapest(double room, double over_ns = 0, double most_ns = 1e300) const;
    /// The cheapest of those that are finer in all that can still be made finer: what is to blame
    /// is not known.
    ProposedBeams finer_in_all(const ProposedBeams& drawn) const;
    /// The same choices, where they are among these; else a price of 0.
    ProposedBeams as_fine_as(const ProposedBeams& drawn) const;
    /// These were off by so much at least: what was guessed is put right.
    void learn(const ProposedBeams& drawn, double error);

private:
    std::vector<ProposedBeams> all() const;
    double borders_of(bool preview, double tolerance) const;
    double price_of(const ProposedBeams& beams) const;

    double guess_ = 1;  // of all but effects, as pictures have shown
};

}  // namespace culet
