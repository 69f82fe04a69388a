#include "fit/findings/bench_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace culet {

std::string bench_words(const NextReading& reading) {
    const std::string of = fmt::format("{}", fmt::join(reading.of, " and "));
    switch (reading.kind) {
        case ReadingKind::inclination:
            return "read the inclination of " + of;
        case ReadingKind::azimuth:
            return "read the azimuth (the index) of " + of;
        case ReadingKind::width:
            return "measure the width at " + of + " degrees";
        case ReadingKind::table_width:
            return "measure the table's width at " + of + " degrees";
        case ReadingKind::depth:
            return "measure the depth";
        case ReadingKind::weight:
            return "weigh the stone";
        case ReadingKind::volume:
            return "find the volume";
        case ReadingKind::edge:
            return "measure the edge between " + of;
        case ReadingKind::distance:
            return "measure the distance of " + of;
        default:
            break;
    }
    return std::string("read the ") + name_of(reading.kind) + " of " + of;
}

}  // namespace culet
