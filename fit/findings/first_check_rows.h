#pragma once
// Rows of readings beside the mesh, for the first check. Private to the room.

#include <vector>

#include "fit/findings/first_check.h"
#include "fit/readings/named_tiers.h"
#include "stone/numbers/upper_median.h"

namespace culet {

/// A number that was written once, beside its value in the mesh: the inclinations of one row of a
/// file, or any other reading.
struct CheckedRow {
    std::vector<std::size_t> readings;
    ReadingKind kind = ReadingKind::inclination;
    double value = 0, sigma = 0;
    double mesh = 0;  ///< azimuths: turned like most of the readings
    int tier = -1;    ///< of an angle: the tier of its (first) facet
    int facet = -1;   ///< its (first) facet; -1: the mean of several
    long line = 0;    ///< of the file; 0 if there is none

    /// Difference from the mesh: radians, or log(read / mesh).
    double off() const;
    /// The value at this difference from the mesh.
    double at(double off) const;
};

std::vector<CheckedRow> checked_rows(const Stone& stone, const std::vector<Reading>& readings,
                                     const Vec3& up, const std::vector<NamedTier>& tiers);

/// Median absolute deviation / 0.6745 (Rousseeuw & Croux 1993). 0 for fewer than three.
double robust_sigma(const std::vector<double>& values);

/// `33.7 to 33.9`, from radians.
std::string range_of(const std::vector<double>& values);

/// Doubts all rows of a tier that is off the mesh as a whole, if none is odd by itself.
/// `from_mesh`: how far a tier is expected to be off.
void check_tiers(const std::vector<Reading>& readings, const std::vector<CheckedRow>& rows,
                 const std::vector<NamedTier>& tiers, double from_mesh, std::vector<Doubt>& doubts);

}  // namespace culet
