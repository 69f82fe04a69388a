#include "render/scene/photometry.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stone/numbers/units.h"

namespace culet {

namespace {

// The place of a value between a list's numbers.
struct Place {
    std::size_t before = 0;
    double past = 0;  // 0..1
};
std::optional<Place> place_in(const std::vector<double>& list, double value) {
    constexpr double k_rounding = 1e-9;
    if (value < list.front() - k_rounding || value > list.back() + k_rounding) return std::nullopt;
    if (list.size() == 1) return Place{};
    const auto after = std::upper_bound(list.begin() + 1, list.end() - 1, value);
    const double from = *(after - 1);
    return Place{std::size_t(after - list.begin()) - 1,
                 std::clamp((value - from) / (*after - from), 0.0, 1.0)};
}

// Moves C, 0 to 360, into the measured part.
double folded(double c, double first, double last) {
    if (first == last) return first;
    if (first == -90) return c > 270 ? c - 360 : c > 90 ? 180 - c : c;
    if (first == 90) return c > 270 ? 540 - c : c < 90 ? 180 - c : c;
    if (last <= 180 && c > 180) c = 360 - c;
    return last <= 90 && c > 90 ? 180 - c : c;
}

}  // namespace

double Photometry::at(const glm::dvec3& d) const {
    using std::atan2;
    double v = 0, h = 0;
    switch (type) {
        case Type::c:
            v = degrees(atan2(std::hypot(d.x, d.y), d.z));
            h = degrees(atan2(d.y, d.x));
            h = folded(h < 0 ? h + 360 : h, horizontal.front(), horizontal.back());
            break;
        case Type::b:
            v = degrees(atan2(d.x, d.z));
            h = degrees(atan2(-d.y, std::hypot(d.x, d.z)));
            break;
        case Type::a:
            v = degrees(atan2(d.x, std::hypot(d.y, d.z)));
            h = degrees(atan2(-d.y, d.z));
            break;
    }
    if (type != Type::c && horizontal.front() == 0) h = std::abs(h);
    const auto row = place_in(vertical, v), plane = place_in(horizontal, h);
    if (!row || !plane) return 0;
    const auto along = [&](std::size_t of_plane) {
        const double* values = &candela[of_plane * vertical.size() + row->before];
        return values[0] + row->past * (values[1] - values[0]);
    };
    const double here = along(plane->before);
    return plane->past > 0 ? here + plane->past * (along(plane->before + 1) - here) : here;
}

double Photometry::factor_at_tilt(double degrees) const {
    if (tilt.empty()) return 1;
    const auto place = place_in(tilt, std::clamp(degrees, tilt.front(), tilt.back()));
    const double here = tilt_factor[place->before];
    return place->past > 0 ? here + place->past * (tilt_factor[place->before + 1] - here) : here;
}

}  // namespace culet
