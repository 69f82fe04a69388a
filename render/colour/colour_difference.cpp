#include "render/colour/colour_difference.h"

#include <algorithm>
#include <cmath>

#include "stone/numbers/units.h"

namespace culet {

namespace {

// CIE 15:2004, equations 8.3 to 8.8 with the exact fractions.
double lab_curve(double t) {
    constexpr double edge = 216.0 / 24389, slope = 24389.0 / 27;
    return t > edge ? std::cbrt(t) : (slope * t + 16) / 116;
}

// sqrt(C^7 / (C^7 + 25^7)): 0 at grey, 1 far from it (equations 4 and 17).
double near_grey(double chroma) {
    const double seventh = std::pow(chroma, 7);
    return std::sqrt(seventh / (seventh + 6103515625.0));
}

double hue_deg(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double hue = degrees(std::atan2(b, a));
    return hue < 0 ? hue + 360 : hue;
}

double cos_deg(double angle_deg) {
    return std::cos(radians(angle_deg));
}

}  // namespace

Lab lab_from_linear_srgb(double red, double green, double blue) {
    const double x = 0.4124 * red + 0.3576 * green + 0.1805 * blue;
    const double y = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    const double z = 0.0193 * red + 0.1192 * green + 0.9505 * blue;
    // White computed from these rows, so that equal channels are exactly grey.
    const double fx = lab_curve(x / 0.9505), fy = lab_curve(y), fz = lab_curve(z / 1.0890);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

double ciede2000(const Lab& first, const Lab& second) {
    // Chroma and hue with a* stretched near grey (equations 2 to 7).
    const double mean_raw_chroma =
        (std::hypot(first.a, first.b) + std::hypot(second.a, second.b)) / 2;
    const double stretch = 1 + 0.5 * (1 - near_grey(mean_raw_chroma));
    const double a1 = stretch * first.a, a2 = stretch * second.a;
    const double chroma1 = std::hypot(a1, first.b), chroma2 = std::hypot(a2, second.b);
    const double hue1 = hue_deg(a1, first.b), hue2 = hue_deg(a2, second.b);

    // Differences (8 to 11); hue by the shorter arc.
    const bool grey = chroma1 * chroma2 == 0;
    double hue_step = grey ? 0 : hue2 - hue1;
    if (hue_step > 180) hue_step -= 360;
    if (hue_step < -180) hue_step += 360;
    const double delta_L = second.L - first.L, delta_C = chroma2 - chroma1;
    const double delta_H = 2 * std::sqrt(chroma1 * chroma2) * std::sin(radians(hue_step / 2));

    // Means (12 to 14).
    const double mean_L = (first.L + second.L) / 2, mean_C = (chroma1 + chroma2) / 2;
    double mean_hue = hue1 + hue2;
    if (!grey) {
        if (std::abs(hue1 - hue2) > 180) mean_hue += mean_hue < 360 ? 360 : -360;
        mean_hue /= 2;
    }

    // Weights (15 to 21).
    const double T = 1 - 0.17 * cos_deg(mean_hue - 30) + 0.24 * cos_deg(2 * mean_hue) +
                     0.32 * cos_deg(3 * mean_hue + 6) - 0.20 * cos_deg(4 * mean_hue - 63);
    const double from_blue = (mean_hue - 275) / 25;
    const double turn_deg = 30 * std::exp(-from_blue * from_blue);
    const double from_middle = (mean_L - 50) * (mean_L - 50);
    const double S_L = 1 + 0.015 * from_middle / std::sqrt(20 + from_middle);
    const double S_C = 1 + 0.045 * mean_C, S_H = 1 + 0.015 * mean_C * T;
    const double R_T = -std::sin(radians(2 * turn_deg)) * 2 * near_grey(mean_C);

    const double l = delta_L / S_L, c = delta_C / S_C, h = delta_H / S_H;
    return std::sqrt(std::max(0.0, l * l + c * c + h * h + R_T * c * h));
}

}  // namespace culet
