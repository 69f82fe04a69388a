#pragma once
// Parts of the first check. Private to the room.

#include <map>
#include <vector>

#include "fit/findings/first_check.h"
#include "fit/readings/named_tiers.h"

namespace culet {

/// Readings that stand in one row of a file: one slip makes all of them wrong.
struct Row {
    std::vector<std::size_t> readings;
    double value = 0, sigma = 0;  ///< of one of them
};
/// Of the readings that are asked for; a reading from no file is a row by itself.
std::vector<Row> rows_of(const std::vector<Reading>& readings,
                         const std::vector<std::size_t>& asked);

/// What a row should be about, and how far off an honest one would be.
struct Expected {
    double value = 0, sigma = 0;
    std::string by;  ///< in words: `its seven sisters (33.7 to 33.9)`, `the mesh (33.8)`
};

/// Of a row whose quantity is `own_mesh` in the mesh, from the values of others like it and by how
/// much each of them is off the mesh. `floor` is how much honest ones differ at least.
Expected expected_of_sisters(const Row& own, double own_mesh, const std::vector<double>& values,
                             const std::vector<double>& off_mesh, double floor);

/// Half of the numbers are nearer to their median than this times 0.6745: a robust sigma. 0 for
/// fewer than three.
double robust_sigma(const std::vector<double>& values);
double median(std::vector<double> values);

/// Adds the row's readings where it is too far off what is expected of it. Angles in radians.
void doubt_if_far(const std::vector<Reading>& readings, const Row& row, const Expected& expected,
                  std::vector<Doubt>& doubts);

/// An inclination of one facet, or the mean of some.
struct ReadAngle {
    Row row;
    int facet = -1;   ///< the first of them
    double mesh = 0;  ///< what it is in the mesh
    double off() const { return row.value - mesh; }
};

std::string count_words(std::size_t n);  ///< `seven`, `28`
/// `33.7 to 33.9`, of radians.
std::string range_of(const std::vector<double>& values);

/// Doubts all rows of a tier that is off the mesh as a whole. `tier_of`: of each facet, or -1.
void check_tiers(const std::vector<Reading>& readings, const std::vector<ReadAngle>& angles,
                 const std::vector<int>& tier_of, const std::vector<NamedTier>& tiers,
                 double from_mesh, std::vector<Doubt>& doubts);

void check_angles(const Stone& stone, const std::vector<Reading>& readings, bool is_design,
                  std::vector<Doubt>& doubts);
void check_lengths(const Stone& stone, const std::vector<Reading>& readings, bool is_design,
                   std::vector<Doubt>& doubts);

}  // namespace culet
