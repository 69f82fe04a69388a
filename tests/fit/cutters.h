#pragma once
// A simulated cutter's evening: an off-standard stone cut after a catalogue design, and the 26 to
// 40 rows read on it with calipers, one goniometer and a scale, one of them with a writing slip.

#include <cstdint>
#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet::bench {

enum class Slipped {
    none,
    digits_swapped,
    decimal_point,  ///< ten times too much or too little
    first_digit,
    digit_lost,
    digit_doubled,
    other_side,  ///< 90 degrees less the angle
    inches,
    grams,
    other_tier,      ///< the value of a facet of another tier
    rows_exchanged,  ///< a crown main's value and a pavilion main's
    turned_digit,    ///< 6 for 9, 1 for 7, 3 for 8 in the first two places
    copied_row,      ///< a length's value written again in the row of an angle or length
    whole_tier       ///< a whole tier with the values of another tier
};
inline constexpr int k_slips = 12;  ///< without the last, which affects more than two rows
const char* name_of(Slipped slip);

/// How the stones differ from the design (standard deviations).
struct Population {
    double facet_deg = 0.3;  ///< each facet's inclination and azimuth about those of its tier
    double tier_deg = 0;     ///< each tier's inclination about that of the design
    double offset = 0.002;   ///< each plane's distance, relative to the width
    double two_deg = 0.6;    ///< two mains are steeper or flatter by this
    bool meets = false;      ///< moved to exact meets by the smallest changes, which reduces the
                             ///< tilts
};

struct Evening {
    Stone design;  ///< the mesh that the cutter starts from
    Solid truth;
    std::vector<WrittenReading> rows;
    std::vector<long> wrong_lines;  ///< lines of the rows with the slip
    std::vector<std::string> steep;
    std::vector<bool> was_read;  ///< per facet: its inclination was read individually
};

/// `cut`: step, or a cut whose mains are C1, C2 .. and P1, P2 .., such as an oval. The same seed
/// gives the same evening.
Evening cutters_evening(const std::string& cut, const Population& population, Slipped slip,
                        std::uint64_t seed);

}  // namespace culet::bench
