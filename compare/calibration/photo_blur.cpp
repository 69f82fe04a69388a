#include "compare/calibration/photo_blur.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"

namespace culet {

namespace {

constexpr double k_most = 4, k_step = 0.25;

// Mean square of the detail between one and two pixels, in the root of light, where noise is
// uniform and mostly averaged out over two pixels.
double detail(const cv::Mat& light, double white, const cv::Mat& mask) {
    const cv::Mat root = root_of(light, white);
    const cv::Mat band = softened(root, 1) - softened(root, 2);
    return cv::mean(band.mul(band), mask)[0];
}

}  // namespace

cv::Mat root_of(const cv::Mat& light, double white) {
    cv::Mat root = cv::min(cv::max(light / white, 0), 1);
    cv::sqrt(root, root);
    return root;
}

double photo_blur_px(const MatchedPictures& pictures) {
    // The outline is not detail of the stone: stay clear of it.
    cv::Mat inside;
    cv::erode(pictures.mask, inside, cv::Mat::ones(9, 9, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT,
              cv::Scalar(0));
    if (cv::countNonZero(inside) < 400) return 0;
    const double wanted = detail(luminance(pictures.photo), pictures.white, inside);
    const cv::Mat render = luminance(pictures.render);
    double before = detail(render, pictures.white, inside);
    if (!(wanted > 0) || !(before > wanted)) return 0;
    for (double sigma = k_step; sigma <= k_most; sigma += k_step) {
        const double now = detail(softened(render, sigma), pictures.white, inside);
        if (now <= wanted) {
            // Detail falls about exponentially between two steps.
            const double part = std::log(before / wanted) / std::log(before / std::max(now, 1e-30));
            return sigma - k_step + k_step * std::clamp(part, 0.0, 1.0);
        }
        before = now;
    }
    return k_most;
}

cv::Mat softened(const cv::Mat& picture, double psf_px) {
    if (!(psf_px > 0)) return picture;
    cv::Mat result;
    cv::GaussianBlur(picture, result, {0, 0}, psf_px, psf_px, cv::BORDER_REPLICATE);
    return result;
}

Photo softened(const Photo& picture, double psf_px) {
    Photo result = picture;
    const cv::Mat soft = softened(colour_of(picture), psf_px);
    result.rgb.assign(soft.ptr<float>(), soft.ptr<float>() + 3 * soft.total());
    return result;
}

}  // namespace culet
