#pragma once
// What a fit finds out besides the shape. Plain data: angles in radians, lengths in the stone's
// unit, directions in the frame of the fitted solid.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/solid/solid.h"

namespace culet {

/// A proportion of the cut (cut_quantities.h).
struct FittedProportion {
    std::string name, unit;  ///< unit: %, deg, mm3, ct, the stone's length unit, or empty
    double value = 0, sigma = 0;
};

/// A reading that was not taken and would help.
struct NextReading {
    ReadingKind kind = ReadingKind::inclination;
    std::vector<std::string> of;
    double sigma = 0;     ///< assumed, like other readings of its kind; radians or length
    double reduces = 0;   ///< part of the total variance of all facets that it would remove
    bool closes = false;  ///< it would determine a parameter that nothing determines
};

/// What a suspect reading should have been.
struct Proposal {
    std::string id;
    bool in_radians = false;
    double estimate = 0, sigma = 0;         ///< from the other readings, in the reading's unit
    std::string slip;                       ///< the slip of pen or key that explains it, or empty
    double corrected = 0;                   ///< with a slip: the value without it
    std::vector<std::string> alternatives;  ///< ids that would explain the misfit as well
};

/// The axis about which the facets of each tier are most alike, independent of the facet from which
/// angles are measured.
struct OwnAxis {
    bool known = false;
    std::string basis;  ///< `tiers` or `girdle`; or why there is no axis
    Vec3 direction{0, 0, 1};
    double tilt = 0, azimuth = 0;  ///< tilt from up; azimuth towards which it leans
    double sigma = 0;  ///< of its direction, per component; from the readings' uncertainties
    double scatter_sigma = 0;  ///< the same, from the scatter of facets about their tiers
};

/// Facets that the symmetry of the design maps onto each other.
struct Tier {
    std::string name;  ///< `C*` if it has all C facets and no others; else the first and the last
                       ///< name
    std::vector<int> facets;
    double mean = 0, mean_own_axis = 0;      ///< inclination
    double spread = 0, spread_own_axis = 0;  ///< largest less smallest inclination
    double rms_own_axis = 0;                 ///< root mean square of the differences from the mean
};

/// Facets that differ together from the rest of their tier.
struct OddFacets {
    std::vector<std::string> facets;
    double off = 0, sigma = 0;  ///< steeper than the others by this much; negative if flatter
    double p = 1;  ///< chance of this much if all are alike, corrected for all choices of facets
};

/// The inclinations read in a tier as a cutter names it (named_tiers.h).
struct NamedTierFinding {
    std::string name, words;
    int facets = 0, read = 0;       ///< number of facets, and of those with a reading of their own
    double common = 0, sigma = 0;   ///< inclination of the facets that do not stand out
    double spread = 0;              ///< largest less smallest of those read
    std::vector<OddFacets> odd;     ///< the most certain first
    std::vector<std::string> what;  ///< one sentence each, for people
};

/// One meet of more than three facets.
struct MeetFinding {
    std::vector<std::string> facets;
    std::string how;     ///< `exact`, `soft` or `released`
    double miss = 0;     ///< distance from the common point to the plane furthest from it
    double sigma = 0;    ///< its standard uncertainty; infinite if no reading determines it
    double chi2 = 0;     ///< fall of chi-square when the meet is released (exact meets: predicted)
    int conditions = 0;  ///< planes beyond the first three
    int tested = 0;      ///< how many of them the readings can test
    double p = 1;        ///< chance of this much if the planes do meet
    bool contradicted = false;
    std::string advice;  ///< what to do about it, for people; may be empty
};

/// Where the readings contradict the mesh's topology or cannot confirm it.
struct ShapeFinding {
    enum class Kind {
        edge_vanishes,   ///< readings ask for an edge of negative length: it is held at zero
        facet_vanishes,  ///< readings leave no room for a facet
        edge_open,       ///< an edge is shorter than twice its uncertainty
        facet_open       ///< an area is smaller than twice its uncertainty
    };
    Kind kind = Kind::edge_open;
    std::vector<std::string> facets;  ///< an edge: its two sides, then the facets at its ends
    double value = 0;  ///< length or area; if it vanishes, the value that the readings ask for
    double sigma = 0;
    double p = 1;      ///< if it vanishes: chance of this much if its true value is zero
    std::string what;  ///< one line for people

    /// True if the readings contradict it, false if they leave it open.
    bool is_denied() const { return kind == Kind::edge_vanishes || kind == Kind::facet_vanishes; }
};
const char* name_of(ShapeFinding::Kind kind);

struct GroupTest {
    std::string group;  ///< C8v, C4, Cs, ...
    int order = 1;
    bool mirrors = false;
    double mirror_azimuth = 0;  ///< of one mirror plane's normal, as in `mirror` readings
    int conditions = 0;         ///< that the symmetry puts on the shape
    int tested = 0;             ///< of them, that the readings determine at all
    double chi2 = 0, p = 1;
    bool supported = false;   ///< tested, and not rejected at the significance level
    bool determined = false;  ///< at least half of the conditions are tested
};

struct TierSymmetry {
    std::string tier;
    std::vector<std::string> facets;
    double deviation = 0;  ///< root mean square angle from the symmetric direction; radians
    /// Standard deviation of the true directions from the symmetric ones, with the readings' errors
    /// removed; its standard uncertainty; its upper limit with 95 % confidence.
    double sigma = 0, sigma_sigma = 0, at_most = 0;
    double p = 1;          ///< chance of such deviations if the tier is exactly symmetric
    std::string worst;     ///< the facet that deviates most
    double worst_off = 0;  ///< its deviation; radians
};

struct SymmetryReport {
    std::string form;      ///< the largest group of the form that the stone comes near to
    std::string proposed;  ///< the largest group that the readings support; C1 if there is none
    std::string message;   ///< in one line
    std::vector<GroupTest> groups;    ///< the largest first
    std::vector<TierSymmetry> tiers;  ///< under the form's group
    /// Of all tiers, for "n-fold within sigma degrees".
    double sigma = 0, sigma_sigma = 0;
    /// Readings for a stone file that declare the proposed symmetry.
    std::vector<std::string> readings;
};

}  // namespace culet
