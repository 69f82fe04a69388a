#pragma once
// Parts of the first check: the rows of the readings beside the mesh. Private to the room.

#include <vector>

#include "fit/findings/first_check.h"
#include "fit/readings/named_tiers.h"

namespace culet {

/// A number that was written once, beside what it is in the mesh. Inclinations of one row of a file
/// are one; other readings are a row each.
struct CheckedRow {
    std::vector<std::size_t> readings;
    ReadingKind kind = ReadingKind::inclination;
    double value = 0, sigma = 0;
    double mesh = 0;  ///< azimuths: turned as most were read
    int tier = -1;    ///< of an angle: of its (first) facet
    int facet = -1;   ///< likewise; -1: the mean of several
    long line = 0;    ///< of the file; 0: none

    /// By how much it is off the mesh: radians, or the logarithm of read over drawn.
    double off() const;
    /// What is so far off the mesh.
    double at(double off) const;
};

/// Of all readings that can be held against the mesh, in their order.
std::vector<CheckedRow> checked_rows(const Stone& stone, const std::vector<Reading>& readings,
                                     const Vec3& up, const std::vector<NamedTier>& tiers);

double median(std::vector<double> values);
/// Half of the numbers are nearer to their median than this times 0.6745 (median absolute
/// deviation, Rousseeuw & Croux 1993). 0 for fewer than three.
double robust_sigma(const std::vector<double>& values);

/// `33.7 to 33.9`, of radians.
std::string range_of(const std::vector<double>& values);

/// Doubts all rows of a tier that is off the mesh as a whole, where none is odd by itself.
/// `from_mesh`: how far a tier is expected to be off.
void check_tiers(const std::vector<Reading>& readings, const std::vector<CheckedRow>& rows,
                 const std::vector<NamedTier>& tiers, double from_mesh, std::vector<Doubt>& doubts);

}  // namespace culet
