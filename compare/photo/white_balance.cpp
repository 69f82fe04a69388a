#include "compare/photo/white_balance.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/mcc.hpp>
#include <vector>

#include "compare/photo/pixels.h"
#include "render/colour/colour.h"
#include "render/colour/colour_difference.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/numbers/upper_median.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// ColorChecker Classic, sRGB 8-bit values from the maker's sheet (X-Rite, before November 2014),
// row by row from "dark skin" to "black".
constexpr std::array<std::array<int, 3>, 24> k_chart{{
    {115, 82, 68},   {194, 150, 130}, {98, 122, 157}, {87, 108, 67},   {133, 128, 177},
    {103, 189, 170}, {214, 126, 44},  {80, 91, 166},  {193, 90, 99},   {94, 60, 108},
    {157, 188, 64},  {224, 163, 46},  {56, 61, 150},  {70, 148, 73},   {175, 54, 60},
    {231, 199, 31},  {187, 86, 149},  {8, 133, 161},  {243, 243, 242}, {200, 200, 200},
    {160, 160, 160}, {122, 122, 121}, {85, 85, 85},   {52, 52, 52},
}};

Rgb chart_rgb(std::size_t patch) {
    Rgb rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = srgb_decoded(k_chart[patch][c] / 255.0);
    return rgb;
}

Lab lab_of(const Rgb& rgb) {
    return lab_from_linear_srgb(rgb[0], rgb[1], rgb[2]);
}

double mean_difference(const std::vector<Rgb>& measured) {
    double sum = 0;
    for (std::size_t i = 0; i < measured.size(); ++i)
        sum += ciede2000(lab_of(measured[i]), lab_of(chart_rgb(i)));
    return sum / static_cast<double>(measured.size());
}

bool over(const Photo& photo, std::size_t i) {
    if (!photo.saturated.empty() && photo.saturated[i] > 0) return true;
    return photo.saturation > 0 && std::max({photo.rgb[3 * i], photo.rgb[3 * i + 1],
                                             photo.rgb[3 * i + 2]}) >= 0.98 * photo.saturation;
}

// The corners of a chart, in order from its first patch; none: there is no chart.
std::vector<cv::Point2f> corners_of_chart(const Photo& photo) {
    // The finder needs an 8-bit picture of normal brightness.
    const cv::Mat colour = colour_of(photo), y = luminance(colour);
    const double white = quantile(y, {}, 0.99);
    if (!(white > 0)) return {};
    cv::Mat eight, bgr;
    encoded(colour / white).convertTo(eight, CV_8U, 255);
    cv::cvtColor(eight, bgr, cv::COLOR_RGB2BGR);
    const auto finder = cv::mcc::CCheckerDetector::create();
    try {
        if (!finder->process(bgr, cv::mcc::MCC24, 1)) return {};
        const cv::Ptr<cv::mcc::CChecker> chart = finder->getBestColorChecker();
        return chart.empty() ? std::vector<cv::Point2f>{} : chart->getBox();
    } catch (const cv::Exception&) {
        return {};
    }
}

// Medians of the patches' middles in linear light; none: a patch is outside the picture.
std::vector<Rgb> patches_in(const Photo& photo, const std::vector<cv::Point2f>& box) {
    // Patches of 1 with gaps of an eighth.
    const std::vector<cv::Point2f> model{{0, 0}, {6, 0}, {6, 4}, {0, 4}};
    const cv::Mat picture_from_chart = cv::getPerspectiveTransform(model, box);
    std::vector<Rgb> measured;
    for (int patch = 0; patch < 24; ++patch) {
        std::array<std::vector<float>, 3> values;
        for (int k = 0; k < 49; ++k) {
            const std::vector<cv::Point2f> at{
                {static_cast<float>(patch % 6 + 0.35 + 0.05 * (k % 7)),
                 static_cast<float>(patch / 6 + 0.35 + 0.05 * (k / 7))}};
            std::vector<cv::Point2f> place;
            cv::perspectiveTransform(at, place, picture_from_chart);
            const int px = cvRound(place[0].x), py = cvRound(place[0].y);
            if (px < 0 || py < 0 || px >= photo.width || py >= photo.height) continue;
            const std::size_t i = static_cast<std::size_t>(py) * photo.width + px;
            for (std::size_t c = 0; c < 3; ++c) values[c].push_back(photo.rgb[3 * i + c]);
        }
        if (values[0].size() < 9) return {};
        measured.push_back(
            {upper_median(values[0]), upper_median(values[1]), upper_median(values[2])});
    }
    return measured;
}

// Takes the matrix from balanced patches, and their differences with and without it.
void fit_matrix(const std::vector<Rgb>& measured, ChartBalance& result) {
    Eigen::MatrixXd from(24, 3), to(24, 3);
    for (int i = 0; i < 24; ++i) {
        for (int c = 0; c < 3; ++c) {
            const auto k = static_cast<std::size_t>(c), patch = static_cast<std::size_t>(i);
            from(i, c) = measured[patch][k];
            to(i, c) = chart_rgb(patch)[k];
        }
    }
    const Eigen::MatrixXd solved = PivotedQr(from).solve(to);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            result.matrix[static_cast<std::size_t>(3 * r + c)] = solved(c, r);
    std::vector<Rgb> corrected;
    for (const Rgb& rgb : measured) {
        Rgb out{};
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c) out[r] += result.matrix[3 * r + c] * rgb[c];
            out[r] = std::max(out[r], 0.0);
        }
        corrected.push_back(out);
    }
    result.before = mean_difference(measured);
    result.after = mean_difference(corrected);
}

}  // namespace

GreyCard measure_grey(const Photo& photo, const PixelRectangle& card) {
    if (card.x < 0 || card.y < 0 || card.width < 4 || card.height < 4 ||
        card.width > photo.width - card.x || card.height > photo.height - card.y) {
        throw InputError(
            fmt::format("the grey card {},{},{},{} must lie in the picture of {} x {} "
                        "pixels and be at least 4 x 4: --grey is X,Y,WIDTH,HEIGHT from "
                        "the top left",
                        card.x, card.y, card.width, card.height, photo.width, photo.height));
    }
    std::array<std::vector<float>, 3> values;
    double clipped = 0, sum = 0, squares = 0;
    for (int y = card.y; y < card.y + card.height; ++y) {
        for (int x = card.x; x < card.x + card.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * photo.width + x;
            for (std::size_t c = 0; c < 3; ++c) values[c].push_back(photo.rgb[3 * i + c]);
            const double g = photo.rgb[3 * i + 1];
            sum += g;
            squares += g * g;
            if (over(photo, i)) ++clipped;
        }
    }
    GreyCard grey;
    const double n = static_cast<double>(values[0].size());
    grey.over_exposed = clipped / n;
    if (grey.over_exposed > 0.02) {
        throw InputError(
            fmt::format("{:.0f} % of the grey card is over-exposed: white cannot be found from it; "
                        "expose it darker",
                        100 * grey.over_exposed));
    }
    std::array<double, 3> middle{};
    for (std::size_t c = 0; c < 3; ++c) middle[c] = upper_median(std::move(values[c]));
    if (!(middle[0] > 0 && middle[1] > 0 && middle[2] > 0))
        throw InputError("the grey card is black: expose it brighter, or check the rectangle");
    for (std::size_t c = 0; c < 3; ++c) grey.gain[c] = middle[1] / middle[c];
    grey.level = middle[1];
    grey.unevenness = std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n))) / (sum / n);
    return grey;
}

std::optional<ChartBalance> find_colour_chart(const Photo& photo) {
    const std::vector<cv::Point2f> box = corners_of_chart(photo);
    if (box.size() != 4) return std::nullopt;
    std::vector<Rgb> measured = patches_in(photo, box);
    if (measured.empty()) return std::nullopt;
    ChartBalance result;
    // The middle greys also give the common exposure: white may clip, and black is mostly haze.
    double exposure = 0;
    std::array<double, 3> grey{};
    for (std::size_t patch = 19; patch < 23; ++patch) {
        for (std::size_t c = 0; c < 3; ++c) grey[c] += measured[patch][c];
        exposure += chart_rgb(patch)[1];
    }
    if (!(grey[0] > 0 && grey[1] > 0 && grey[2] > 0)) return std::nullopt;
    for (std::size_t c = 0; c < 3; ++c) result.gain[c] = grey[1] / grey[c];
    exposure /= grey[1];
    for (Rgb& patch : measured)
        for (std::size_t c = 0; c < 3; ++c) patch[c] *= result.gain[c] * exposure;
    fit_matrix(measured, result);
    // A chart of very different colours is a false detection.
    if (!(result.after < 15)) return std::nullopt;
    return result;
}

void balance(Photo& photo, const std::array<double, 3>& gain) {
    for (std::size_t i = 0; i < photo.rgb.size(); ++i)
        photo.rgb[i] *= static_cast<float>(gain[i % 3]);
    for (std::size_t i = 0; i < photo.variance.size(); ++i)
        photo.variance[i] *= static_cast<float>(gain[i % 3] * gain[i % 3]);
}

void apply_colour_matrix(Photo& photo, const std::array<double, 9>& m) {
    for (std::size_t i = 0; i + 2 < photo.rgb.size(); i += 3) {
        const std::array<double, 3> from{photo.rgb[i], photo.rgb[i + 1], photo.rgb[i + 2]};
        std::array<double, 3> variance{};
        if (!photo.variance.empty())
            variance = {photo.variance[i], photo.variance[i + 1], photo.variance[i + 2]};
        for (std::size_t r = 0; r < 3; ++r) {
            double sum = 0, spread = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                sum += m[3 * r + c] * from[c];
                spread += m[3 * r + c] * m[3 * r + c] * variance[c];
            }
            photo.rgb[i + r] = static_cast<float>(std::max(sum, 0.0));
            if (!photo.variance.empty()) photo.variance[i + r] = static_cast<float>(spread);
        }
    }
}

}  // namespace culet
