#include "compare/scores/metrics.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "compare/photo/pixels.h"
#include "render/colour/colour_difference.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr int k_most_for_gain = 30000;

template <class Visit>
void for_each_masked(const cv::Mat& mask, const Visit& visit) {
    for (int y = 0; y < mask.rows; ++y) {
        const unsigned char* m = mask.ptr<unsigned char>(y);
        for (int x = 0; x < mask.cols; ++x) {
            if (m[x] != 0) visit(y, x);
        }
    }
}

double mean_under(const cv::Mat& plane, const cv::Mat& mask) {
    double sum = 0, count = 0;
    for_each_masked(mask, [&](int y, int x) {
        sum += plane.at<float>(y, x);
        ++count;
    });
    return count > 0 ? sum / count : 0;
}

cv::Mat root_luminance(const cv::Mat& colour, double white) {
    cv::Mat result = luminance(colour);
    cv::min(result, white, result);
    cv::max(result, 0, result);
    cv::sqrt(result / white, result);
    return result;
}

// Sigma of the residuals from their median: 1.4826 is 1 over the normal quantile of 3/4.
double spread(std::vector<double> residuals) {
    return 1.4826 * upper_median(std::move(residuals));
}

double gain_of_channel(const std::vector<double>& photo, const std::vector<double>& render) {
    double photo_sum = 0, render_sum = 0;
    for (std::size_t i = 0; i < photo.size(); ++i) {
        photo_sum += photo[i];
        render_sum += render[i];
    }
    if (!(photo_sum > 0) || !(render_sum > 0)) return 1;
    double gain = photo_sum / render_sum;
    std::vector<double> off(photo.size());
    for (int round = 0; round < 20; ++round) {
        for (std::size_t i = 0; i < photo.size(); ++i)
            off[i] = std::abs(photo[i] - gain * render[i]);
        // Huber's constant: 95 % efficiency for normal noise. The floor keeps an exact fit exact.
        const double floor = 1e-6 * photo_sum / static_cast<double>(photo.size());
        const double limit = std::max(floor, 1.345 * spread(off));
        double top = 0, bottom = 0;
        for (std::size_t i = 0; i < photo.size(); ++i) {
            const double weight = off[i] <= limit ? 1 : limit / off[i];
            top += weight * render[i] * photo[i];
            bottom += weight * render[i] * render[i];
        }
        if (!(top > 0) || !(bottom > 0)) return gain;
        const double next = top / bottom;
        const bool settled = std::abs(next - gain) < 1e-9 * gain;
        gain = next;
        if (settled) break;
    }
    return gain;
}

}  // namespace

std::array<double, 3> solve_gain(const cv::Mat& photo, const cv::Mat& render,
                                 const cv::Mat& usable) {
    std::array<double, 3> gain{1, 1, 1};
    // A subset of the pixels is enough for three numbers.
    const int step = 1 + cv::countNonZero(usable) / k_most_for_gain;
    for (int c = 0; c < 3; ++c) {
        std::vector<double> p, r;
        int count = 0;
        for_each_masked(usable, [&](int y, int x) {
            if (count++ % step != 0) return;
            p.push_back(photo.at<cv::Vec3f>(y, x)[c]);
            r.push_back(render.at<cv::Vec3f>(y, x)[c]);
        });
        if (!p.empty()) gain[static_cast<std::size_t>(c)] = gain_of_channel(p, r);
    }
    return gain;
}

ShownPictures shown(const MatchedPictures& pictures) {
    ShownPictures result;
    const double scale = 1 / pictures.white;
    result.photo = encoded(pictures.photo * scale);
    result.render = encoded(pictures.render * scale);
    result.photo_luma = encoded(luminance(pictures.photo) * scale);
    result.render_luma = encoded(luminance(pictures.render) * scale);
    return result;
}

std::vector<std::optional<double>> zncc(const MatchedPictures& pictures,
                                        const std::vector<double>& blurs) {
    // Normalised convolution: blurs both pictures under the mask and divides by the blurred mask,
    // so that nothing enters from outside.
    cv::Mat masked;
    {
        cv::Mat inside;
        pictures.mask.convertTo(inside, CV_32F, 1.0 / 255);
        const cv::Mat planes[] = {root_luminance(pictures.photo, pictures.white).mul(inside),
                                  root_luminance(pictures.render, pictures.white).mul(inside),
                                  inside};
        cv::merge(planes, 3, masked);
    }
    std::vector<std::optional<double>> values;
    for (const double blur : blurs) {
        const double sigma = blur * pictures.diameter;
        cv::Mat blurred;
        cv::GaussianBlur(masked, blurred, {0, 0}, sigma, sigma, cv::BORDER_CONSTANT);
        double p = 0, r = 0, count = 0;
        for_each_masked(pictures.mask, [&](int y, int x) {
            cv::Vec3f& v = blurred.at<cv::Vec3f>(y, x);
            v[0] /= v[2];
            v[1] /= v[2];
            p += static_cast<double>(v[0]);
            r += static_cast<double>(v[1]);
            ++count;
        });
        const double p_mean = p / count, r_mean = r / count;
        double pp = 0, rr = 0, pr = 0;
        for_each_masked(pictures.mask, [&](int y, int x) {
            const cv::Vec3f& v = blurred.at<cv::Vec3f>(y, x);
            const double dp = static_cast<double>(v[0]) - p_mean,
                         dr = static_cast<double>(v[1]) - r_mean;
            pp += dp * dp;
            rr += dr * dr;
            pr += dp * dr;
        });
        // Uniform: contrast below the precision of single floats and 8 bits.
        const double least = count * 1e-4 * 1e-4;
        if (pp <= least || rr <= least) {
            values.emplace_back();
        } else {
            values.emplace_back(std::clamp(pr / std::sqrt(pp * rr), -1.0, 1.0));
        }
    }
    return values;
}

std::optional<double> zncc(const MatchedPictures& pictures, double blur) {
    return zncc(pictures, std::vector{blur}).front();
}

ScoreMap ssim(const ShownPictures& pictures, const cv::Mat& mask) {
    const auto window = [](const cv::Mat& plane) {
        cv::Mat mean;
        cv::GaussianBlur(plane, mean, {11, 11}, 1.5, 1.5, cv::BORDER_REPLICATE);
        return mean;
    };
    const cv::Mat x = pictures.photo_luma * 255, y = pictures.render_luma * 255;
    const cv::Mat mean_x = window(x), mean_y = window(y);
    const cv::Mat mean_xx = mean_x.mul(mean_x), mean_yy = mean_y.mul(mean_y);
    const cv::Mat mean_xy = mean_x.mul(mean_y);
    const cv::Mat var_x = window(x.mul(x)) - mean_xx, var_y = window(y.mul(y)) - mean_yy;
    const cv::Mat covariance = window(x.mul(y)) - mean_xy;
    const double C1 = 6.5025, C2 = 58.5225;  // (0.01 * 255)^2, (0.03 * 255)^2
    const cv::Mat top_mean = 2 * mean_xy + C1, top_shape = 2 * covariance + C2;
    const cv::Mat bottom_mean = mean_xx + mean_yy + C1, bottom_shape = var_x + var_y + C2;
    ScoreMap result;
    result.map = top_mean.mul(top_shape) / bottom_mean.mul(bottom_shape);
    result.mean = mean_under(result.map, mask);
    return result;
}

std::optional<double> psnr(const ShownPictures& pictures, const cv::Mat& mask) {
    double sum = 0, count = 0;
    for_each_masked(mask, [&](int y, int x) {
        const cv::Vec3f d =
            pictures.photo.at<cv::Vec3f>(y, x) - pictures.render.at<cv::Vec3f>(y, x);
        sum += static_cast<double>(d.dot(d));
        count += 3;
    });
    if (!(sum > 0) || !(count > 0)) return std::nullopt;
    return 10 * std::log10(count / sum);
}

ColourScore deltaE00(const MatchedPictures& pictures) {
    ColourScore result;
    result.map = cv::Mat::zeros(pictures.mask.size(), CV_32F);
    const auto lab_at = [&](const cv::Mat& colour, int y, int x) {
        const cv::Vec3f v = colour.at<cv::Vec3f>(y, x);
        const auto part = [&](float c) {
            return std::clamp(static_cast<double>(c) / pictures.white, 0.0, 1.0);
        };
        return lab_from_linear_srgb(part(v[0]), part(v[1]), part(v[2]));
    };
    for_each_masked(pictures.mask, [&](int y, int x) {
        result.map.at<float>(y, x) = static_cast<float>(
            ciede2000(lab_at(pictures.photo, y, x), lab_at(pictures.render, y, x)));
    });
    result.mean = mean_under(result.map, pictures.mask);
    result.percentile_95 = quantile(result.map, pictures.mask, 0.95);
    return result;
}

}  // namespace culet
