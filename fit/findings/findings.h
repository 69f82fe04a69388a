#pragma once
// What a fit finds out besides the stone's shape: proportions, what suspects should have been, what
// to read next; the stone's own axis and tiers, which meets the readings contradict, what its
// topology should be, and its symmetry. Plain data; angles in
// radians, lengths in the stone's unit, directions in the frame of the fitted solid.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/solid/solid.h"

namespace culet {

/// A proportion of the cut (see cut_quantities.h for the definitions).
struct FittedProportion {
    std::string name, unit;  ///< unit: %, deg, mm3, ct, the stone's length unit, or empty
    double value = 0, sigma = 0;
};

/// A reading that was not made and would help.
struct NextReading {
    ReadingKind kind = ReadingKind::inclination;
    std::vector<std::string> of;
    double sigma =
        0;  ///< that is supposed: as of the other readings of its kind; radians or length
    double reduces = 0;   ///< part of the total variance of all facets that it would take away
    bool closes = false;  ///< it would determine a freedom that nothing determines
};

/// What a suspect reading should have been.
struct Proposal {
    std::string id;
    bool in_radians = false;
    double estimate = 0, sigma = 0;  ///< from the other readings, in the reading's unit
    std::string slip;                ///< the slip of pen or key that would explain it, or empty
    double corrected = 0;            ///< with a slip: the value without it
    std::vector<std::string> alternatives;  ///< ids that would explain the misfit as well
};

/// The axis about which the facets of each tier are most alike: of the stone itself, whatever facet
/// its angles are read from.
struct OwnAxis {
    bool known = false;
    std::string basis;  ///< `tiers`, `girdle`; or why there is none
    Vec3 direction{0, 0, 1};
    double tilt = 0, azimuth = 0;  ///< from up, and towards where it leans
    double sigma = 0;              ///< of its direction, across; as far as the readings know it
    double scatter_sigma = 0;      ///< the same, from how facets scatter about their tiers
};

/// Facets that the symmetry of the stone's form takes into each other.
struct Tier {
    std::string name;  ///< C* when all are C and a number, or the first and the last
    std::vector<int> facets;
    double mean = 0, mean_own_axis = 0;      ///< inclination
    double spread = 0, spread_own_axis = 0;  ///< largest less least inclination
    double rms_own_axis = 0;                 ///< of the differences from the mean
};

/// Facets of a tier that stand out from it together.
struct OddFacets {
    std::vector<std::string> facets;
    double off = 0, sigma = 0;  ///< steeper than the others by this much; flatter: negative
    double p = 1;  ///< chance of so much if all are alike, all choices of facets counted
};

/// What was read of the inclinations of a tier as a cutter names it (named_tiers.h).
struct NamedTierFinding {
    std::string name, words;
    int facets = 0, read = 0;       ///< of how many, and how many of them by a reading of their own
    double common = 0, sigma = 0;   ///< inclination of those that do not stand out
    double spread = 0;              ///< largest less least of those read
    std::vector<OddFacets> odd;     ///< the surest first
    std::vector<std::string> what;  ///< one sentence each, for people
};

/// One meet of more than three facets.
struct MeetFinding {
    std::vector<std::string> facets;
    std::string how;     ///< `exact`, `soft` or `released`
    double miss = 0;     ///< by how much the facet that is furthest off passes the common point
    double sigma = 0;    ///< its standard uncertainty; infinite when no reading tells
    double chi2 = 0;     ///< by how much chi-square falls (exact: would fall) when it is let go
    int conditions = 0;  ///< planes beyond three
    int tested = 0;      ///< of these, that the readings can tell
    double p = 1;        ///< chance of so much if the planes do meet
    bool contradicted = false;
    std::string advice;  ///< what to do about it, for people; empty: nothing
};

/// Where the readings leave it open, or deny, that the stone hangs together as the mesh does.
struct ShapeFinding {
    enum class Kind {
        edge_vanishes,   ///< readings want an edge of negative length: it is held at zero
        facet_vanishes,  ///< readings want no room for a facet
        edge_open,       ///< an edge shorter than twice its uncertainty
        facet_open       ///< an area smaller than twice its uncertainty
    };
    Kind kind = Kind::edge_open;
    std::vector<std::string> facets;  ///< an edge: its two sides, then the facets at its ends
    double value = 0;                 ///< length or area; of vanishing ones what the readings want
    double sigma = 0;
    double p = 1;  ///< of vanishing ones: chance of so strong a wish if there is just no such edge
    std::string what;  ///< one line for people

    /// By the readings; else they leave it open.
    bool is_denied() const { return kind == Kind::edge_vanishes || kind == Kind::facet_vanishes; }
};
const char* name_of(ShapeFinding::Kind kind);

/// One group held against the readings.
struct GroupTest {
    std::string group;  ///< C8v, C4, Cs, ...
    int order = 1;
    bool mirrors = false;
    double mirror_azimuth = 0;  ///< of one mirror plane's normal, as `mirror` readings count it
    int conditions = 0;         ///< that symmetry would put on the shape
    int tested = 0;             ///< of these, that the readings tell anything of
    double chi2 = 0, p = 1;
    bool supported = false;   ///< tested, and not denied at the level
    bool determined = false;  ///< at least half of the conditions are tested
};

/// How far the facets of one tier are from being alike.
struct TierSymmetry {
    std::string tier;
    std::vector<std::string> facets;
    double deviation = 0;  ///< root mean square angle off the symmetric direction; radians
    /// Standard deviation of the true directions about symmetry, what the readings cannot know
    /// taken away; its own standard uncertainty; and with 95 % confidence no more than `at_most`.
    double sigma = 0, sigma_sigma = 0, at_most = 0;
    double p = 1;          ///< chance of such deviations if the tier is exactly alike
    std::string worst;     ///< the facet furthest off
    double worst_off = 0;  ///< by this much; radians
};

struct SymmetryReport {
    std::string form;      ///< the largest group that the form itself has and comes near to
    std::string proposed;  ///< the largest group that the readings support; C1: none
    std::string message;   ///< in one line
    std::vector<GroupTest> groups;    ///< the largest first
    std::vector<TierSymmetry> tiers;  ///< under the form's group
    /// Of all tiers together: to write "n-fold within sigma degrees".
    double sigma = 0, sigma_sigma = 0;
    /// Readings that would declare the proposal, in the words of a stone file.
    std::vector<std::string> readings;
};

}  // namespace culet
