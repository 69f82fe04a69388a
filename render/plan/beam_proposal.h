#pragma once
// The cheapest beams that are likely near enough.
//
// What they are off by has four causes: light that is cut, so few wavelengths, effects left out,
// and borders and colours of regions. Causes of their own add up as squares do. The first three a
// pilot has seen; of the last there is a model, measured on 15 scenes at three sizes, which is
// right within a factor of three or so. Pictures that were held against the truth say more.

#include <array>
#include <map>
#include <vector>

#include "render/scene.h"

namespace culet {

/// Of what is left of the tolerance, what beams may be off by; and where the two waves of a crystal
/// go as one for a try.
constexpr double k_share_of_beams = 0.65, k_share_as_one = 0.4;

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
    double borders = 0;   ///< what they are off by, as the model has it
    double error = 0;     ///< with all causes, as pictures have shown
    double price_ns = 0;  ///< price.h

    void apply_to(RenderSettings& settings) const;
    /// As coarse as `other` in all, or coarser.
    bool no_finer_than(const ProposedBeams& other) const;
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
    bool parted = false;  ///< a crystal's two waves, each its own way
    bool previews = true, borders_are_open = true;

    /// The cheapest that is likely off by `room` at most, of those that cost at most `most_ns` and
    /// are not as coarse as one that was not near enough; if none is, of these the cheapest that is
    /// about as likely near enough as any. A price of 0: there is none.
    ProposedBeams cheapest(double room, double most_ns = 1e300) const;

    /// These were off by so much, which was too much. What each cause was guessed to bring is put
    /// right by a factor: of log-normal factors and all such pictures its mean square (Bayes). So
    /// all is suspected that may have brought it, what brought most the most, and what was made
    /// finer in vain no longer.
    void learn(const ProposedBeams& drawn, double error);
    /// What a choice is off by, as pixels show that were chosen for where pictures are off
    /// (proof_pilot.h): no guess any more. Finer ones are off in proportion to what was guessed, by
    /// as much at most; coarser ones by as much at least, and in proportion where it is more than
    /// was guessed. To be told from the coarsest on.
    void know_cut(double weight, double error);
    void know_wavelengths(int count, double error);
    bool knows_cut(double weight) const { return known_cuts_.contains(weight); }
    bool knows_wavelengths(int count) const { return known_wavelengths_.contains(count); }
    /// What another proposal has learned of the same scene, where its choices are among these.
    void learn_from(const BeamProposal& other);

private:
    enum Cause { of_cut, of_wavelengths, of_previews, of_beams, of_effects, k_causes };
    struct Seen {
        ProposedBeams beams;
        double effects = 0, error = 0;
    };
    using Parts = std::array<double, k_causes>;  // squares
    std::vector<ProposedBeams> all() const;
    double borders_of(bool preview, double tolerance) const;
    double price_of(const ProposedBeams& beams) const;
    static Parts parts_of(const ProposedBeams& beams, double left_out);
    double error_of(const ProposedBeams& beams) const;
    void weigh_causes();
    // Pictures that were seen, by what is known since.
    void put_right_what_was_seen();

    ProposedBeams likeliest(std::vector<ProposedBeams> choices, double room) const;

    // Squares of the causes' factors, and how likely they are.
    struct Belief {
        Parts squares{};
        double weight = 0;
    };
    std::vector<Seen> seen_;
    std::map<double, double> known_cuts_;
    std::map<int, double> known_wavelengths_;
    std::vector<Belief> beliefs_;   // once something was seen
    Parts squares_{1, 1, 1, 1, 1};  // their means
};

}  // namespace culet
