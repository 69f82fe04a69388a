#include "fit/findings/bench_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

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

std::string told_reading(const std::vector<Reading>& readings, const std::string& id) {
    const auto found = std::find_if(readings.begin(), readings.end(),
                                    [&](const Reading& r) { return r.id == id; });
    if (found == readings.end()) return id;
    const std::string what = fmt::format(
        "{}{}{}", name_of(found->kind), found->of.empty() ? "" : " of ", fmt::join(found->of, "/"));
    if (found->line <= 0) return fmt::format("{} ({})", id, what);
    return fmt::format("{} line {} ({}, {})", found->file.filename().string(), found->line, what,
                       id);
}

}  // namespace culet
