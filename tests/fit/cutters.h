#pragma once
// A cutter at the bench: an off-standard stone cut after a catalogue's design, and the 26 to 40
// rows that calipers, one goniometer and a scale read on it in an evening, with a slip of the pen.

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
    first_digit,    ///< another one
    digit_lost,
    digit_doubled,
    other_side,  ///< 90 degrees less the angle
    inches,
    grams,
    other_tier,      ///< the value of a facet of another tier
    rows_exchanged,  ///< a crown main's value and a pavilion main's
    turned_digit,    ///< 6 for 9, 1 for 7, 3 for 8 in the first two places
    copied_row,      ///< a length's value written once more in an angle's or length's row
    whole_tier       ///< all facets of a tier, with the values of another's
};
inline constexpr int k_slips = 12;  ///< but the last, which is in more than a row or two
const char* name_of(Slipped slip);

/// How the stones differ from the design; standard deviations.
struct Population {
    double facet_deg = 0.3;  ///< each facet's inclination and azimuth about its tier's
    double tier_deg = 0;     ///< each tier's inclination about the design's
    double offset = 0.002;   ///< each plane's distance, of the width
    double two_deg = 0.6;    ///< two mains are off by this, up or down
    bool meets = false;      ///< brought to exact meets by least changes, which lessens the tilts
};

struct Evening {
    Stone design;  ///< the mesh that the cutter starts from
    Solid truth;
    std::vector<WrittenReading> rows;
    std::vector<long> wrong_lines;   ///< of the rows with the slip
    std::vector<std::string> steep;  ///< the two mains
    std::vector<bool> was_read;      ///< of each facet: its inclination was, by itself
};

/// `cut`: step, or a cut whose mains are C1, C2 .. and P1, P2 .., such as an oval. The same seed
/// makes the same evening.
Evening cutters_evening(const std::string& cut, const Population& population, Slipped slip,
                        std::uint64_t seed);

}  // namespace culet::bench
