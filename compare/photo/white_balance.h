#pragma once
// What is grey in a photograph, by a card or a colour chart.

#include <array>
#include <optional>

#include "compare/photo/photo.h"

namespace culet {

struct GreyCard {
    std::array<double, 3> gain{1, 1, 1};  ///< per channel; green's is 1
    double level = 0;                     ///< luminance of the card after balancing, linear
    double unevenness = 0;    ///< standard deviation over mean; large for a shadow or a print
    double over_exposed = 0;  ///< share of the rectangle
};

struct PixelRectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Medians of the rectangle's pixels. Throws InputError when it is outside the picture, smaller
/// than 4 x 4, over-exposed or black.
GreyCard measure_grey(const Photo& photo, const PixelRectangle& card);

struct ChartBalance {
    std::array<double, 3> gain{1, 1, 1};  ///< from the four middle greys of the chart's last row
    /// 3 x 3 from the photo's balanced linear RGB to linear sRGB: least squares over 24 patches.
    std::array<double, 9> matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};
    double before = 0,
           after = 0;  ///< mean CIEDE2000 of the patches: with the gains only, and with the matrix
};

/// Finds a ColorChecker Classic (24 patches) by OpenCV's mcc. Nothing when there is none.
std::optional<ChartBalance> find_colour_chart(const Photo& photo);

/// Variances are multiplied by the square; `saturation` stays.
void balance(Photo& photo, const std::array<double, 3>& gain);
void apply_colour_matrix(Photo& photo, const std::array<double, 9>& matrix);

}  // namespace culet
