#include "fit/mesh/notes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace culet {

std::string other_turn(const FitModel& model) {
    constexpr double k_noticed_deg = 5;
    const double turn = degrees(std::remainder(model.frame().mesh_turn(), 2 * std::numbers::pi));
    if (!model.stone().azimuth_from_mesh || std::abs(turn) < k_noticed_deg) return {};
    double as_drawn = 0, turned_back = 0, count = 0;
    for (const Reading& r : model.readings()) {
        if (r.kind != ReadingKind::azimuth || r.datum.kind == Datum::Kind::facet) continue;
        const Vec3& n = model.mesh_shape().normals[std::size_t(r.facets[0])];
        const double off = r.value - std::atan2(n.y, n.x);
        const auto square = [](double angle) {
            return std::pow(degrees(std::remainder(angle, 2 * std::numbers::pi)), 2);
        };
        turned_back += square(off);
        as_drawn += square(off + model.frame().mesh_turn());
        ++count;
    }
    return fmt::format(
        "by the azimuths read, the mesh stands turned by {:.0f} degrees: it was turned back (rms "
        "difference {:.1f} degrees as drawn, {:.1f} turned back); check where azimuths, also those "
        "of widths, are counted from",
        -turn, std::sqrt(as_drawn / count), std::sqrt(turned_back / count));
}

std::string other_size(const FitModel& model) {
    const double factor = model.frame().mesh_scale(), apart = std::max(factor, 1 / factor);
    if (apart < 3) return {};
    std::string guess;
    for (double known : {10.0, 25.4, 100.0, 1000.0}) {
        if (apart > known / 1.6 && apart < known * 1.6) guess = fmt::format("{:g} ", known);
    }
    return fmt::format(
        "the mesh is {} times too {} for the lengths that were read{}: it was scaled; check `unit` "
        "of [stone]",
        guess.empty() ? fmt::format("{:.3g}", apart) : "about " + guess.substr(0, guess.size() - 1),
        factor > 1 ? "small" : "large", guess.empty() ? "" : ", as if drawn in another unit");
}

}  // namespace culet
