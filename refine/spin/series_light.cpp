#include "refine/spin/series_light.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/photo_picture.h"
#include "compare/scores/likeness.h"
#include "refine/spin/zone_shares.h"

namespace culet {

namespace {

// Pixels across the stone, at least.
constexpr double k_render_width = 150;
constexpr int k_light_frames = 24;
// Through a pixel: squares of many pixels need few.
constexpr int k_fit_rays = 1, k_render_rays = 4;
constexpr double k_square = 0.1;        // of the stone's width
constexpr double k_least_light = 0.05;  // below, differences count alike
constexpr int k_sweeps = 2000;
constexpr int k_draws = 60;

using Radiances = Eigen::MatrixX3d;  // by zone

// Sums of least squares.
struct Equations {
    Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(count(), count());
    Radiances light = Radiances::Zero(count(), 3);
    Eigen::VectorXd total = Eigen::VectorXd::Zero(count());

    static Eigen::Index count() { return Eigen::Index(light_zones().size()); }
};

void add_frame(const ZoneShares& given, const cv::Mat& picture, int square, Equations& sums) {
    const auto zones = std::size_t(Equations::count());
    for (int top = 0; top + square <= picture.rows; top += square) {
        for (int left = 0; left + square <= picture.cols; left += square) {
            Eigen::VectorXd shares = Eigen::VectorXd::Zero(Equations::count());
            Eigen::RowVector3d light(0, 0, 0);
            int pixels = 0;
            for (int y = top; y < top + square; ++y) {
                for (int x = left; x < left + square; ++x) {
                    if (given.stone.at<unsigned char>(y, x) == 0) continue;
                    ++pixels;
                    const float* of = &given.shares[std::size_t(y * picture.cols + x) * zones];
                    for (std::size_t z = 0; z < zones; ++z)
                        shares[Eigen::Index(z)] += double(of[z]);
                    const cv::Vec3f& seen = picture.at<cv::Vec3f>(y, x);
                    for (int k = 0; k < 3; ++k) light[k] += double(seen[k]);
                }
            }
            if (2 * pixels < square * square) continue;
            const double weight = 1 / std::max(k_least_light * pixels, light.mean());
            sums.shares += weight * shares * shares.transpose();
            sums.light += weight * shares * light;
            sums.total += shares;
        }
    }
}

// Coordinate descent (Franc, Hlavac, Navara 2005): the zones are few.
Radiances not_negative_solution(const Equations& sums) {
    Radiances found = Radiances::Zero(sums.light.rows(), 3);
    for (int sweep = 0; sweep < k_sweeps; ++sweep) {
        for (Eigen::Index z = 0; z < found.rows(); ++z) {
            const double own = sums.shares(z, z);
            if (!(own > 0)) continue;
            found.row(z) =
                (found.row(z) + (sums.light.row(z) - sums.shares.row(z) * found) / own).cwiseMax(0);
        }
    }
    return found;
}

cv::Mat lit(const ZoneShares& given, const Radiances& radiances) {
    cv::Mat result(given.stone.size(), CV_32FC3, cv::Scalar::all(0));
    const float* share = given.shares.data();
    for (int p = 0; p < int(result.total()); ++p) {
        cv::Vec3f& pixel = result.at<cv::Vec3f>(p / result.cols, p % result.cols);
        for (Eigen::Index z = 0; z < radiances.rows(); ++z, ++share) {
            for (int k = 0; k < 3; ++k) pixel[k] += *share * float(radiances(z, k));
        }
    }
    return result;
}

Photo photo_of(const cv::Mat& colour) {
    Photo photo;
    photo.width = colour.cols;
    photo.height = colour.rows;
    const float* first = colour.ptr<float>();
    photo.rgb.assign(first, first + 3 * colour.total());
    return photo;
}

std::string verdict_of(const SeriesLight& light) {
    const auto beyond = std::count_if(
        light.left_out.begin(), light.left_out.end(),
        [](const FrameLikeness& frame) { return frame.zncc.z.value_or(0) >= k_beyond_chance; });
    const double sigmas = light.mean.z.value_or(0);
    return fmt::format(
        "rendered in the light of the series, the stone {} frames left out: mean correlation "
        "{:.2f}, of turned renders {:.2f} \u00b1 {:.2f} ({:.1f} sigma); {} of {} by {:g} sigma on "
        "their own",
        sigmas >= k_beyond_chance ? "looks like the" : "looks no more than by chance like the",
        *light.mean.value, light.mean.null_mean, light.mean.null_sd, sigmas, beyond,
        light.left_out.size(), k_beyond_chance);
}

std::vector<ZoneLight> zones_with(const Radiances& radiances, const Equations& sums) {
    std::vector<ZoneLight> zones;
    for (const LightZone& zone : light_zones()) {
        const auto z = Eigen::Index(zones.size());
        zones.push_back({zone.name,
                         {zone.from_elevation, zone.to_elevation},
                         {zone.from_azimuth, zone.to_azimuth},
                         {radiances(z, 0), radiances(z, 1), radiances(z, 2)},
                         sums.total[z] / sums.total.sum()});
    }
    return zones;
}

}  // namespace

SeriesLight series_light(const std::vector<SpinFrame>& frames, const SpinResult& found,
                         const Material& material, int threads) {
    const int shrink = std::max(1, int(found.width().value / k_render_width));
    const int square = std::max(1, int(std::lround(k_square * found.width().value / shrink)));
    std::vector<std::size_t> used, left_out;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        if (found.frames[f].used)
            used.push_back(f);
        else if (found.frames[f].turn)
            left_out.push_back(f);
    }
    const auto frame = [&](std::size_t f, int rays) {
        return ShrunkFrame{&frames[f].picture, found.frames[f].projection, shrink, rays};
    };
    const auto shares = [&](const ShrunkFrame& of) {
        return zone_shares(found.solid, material, found.camera, of, threads);
    };

    SeriesLight result;
    Equations sums;
    for (std::size_t k = 0; k < used.size(); k += (used.size() - 1) / k_light_frames + 1) {
        const ShrunkFrame of = frame(used[k], k_fit_rays);
        add_frame(shares(of), shrunk_picture(of), square, sums);
        ++result.frames;
    }
    const Radiances radiances = not_negative_solution(sums);
    result.zones = zones_with(radiances, sums);

    std::vector<cv::Mat> rows;
    std::vector<Score> fine, coarse;
    for (const std::size_t f : left_out) {
        const ShrunkFrame of = frame(f, k_render_rays);
        const ZoneShares given = shares(of);
        const cv::Mat picture = shrunk_picture(of), render = lit(given, radiances);
        const Likeness likely =
            likeness(photo_of(picture), photo_of(render),
                     {given.stone.datastart, given.stone.dataend}, k_draws, f + 1);
        result.left_out.push_back({f, likely.zncc, likely.coarse});
        fine.push_back(likely.zncc);
        coarse.push_back(likely.coarse);
        cv::Mat row, shown = picture.clone();
        render.copyTo(shown, given.stone);
        cv::hconcat(picture, shown, row);
        rows.push_back(row);
    }
    if (rows.empty()) return result;
    result.mean = mean_score(fine);
    result.coarse_mean = mean_score(coarse);
    result.verdict = verdict_of(result);
    cv::Mat sheet;
    cv::vconcat(rows, sheet);
    result.beside = png_of(photo_of(sheet));
    return result;
}

}  // namespace culet
