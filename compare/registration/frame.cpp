#include "compare/registration/frame.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/photo/resampling.h"

namespace culet {

namespace {

constexpr int k_search_size = 1024;  // size at which the stone is searched
constexpr double k_margin = 0.15;    // around the stone, of the diameter
constexpr double k_worth_it = 0.85;  // weaker reductions are not made
constexpr int k_empty_border = 4;    // keeps the outline inside the close-up

cv::Mat reduced(const cv::Mat& picture, double scale) {
    if (scale >= 1 || picture.empty()) return picture;
    const cv::Size size(std::max(1, static_cast<int>(std::lround(picture.cols * scale))),
                        std::max(1, static_cast<int>(std::lround(picture.rows * scale))));
    cv::Mat result;
    cv::resize(picture, result, size, 0, 0, cv::INTER_AREA);
    return result;
}

StoneSource reduced(const StoneSource& source, double scale) {
    return {reduced(source.colour, scale), reduced(source.coverage, scale), source.coverage_name};
}

struct Place {
    cv::Rect box;  // of the stone, in the picture's pixels
    double diameter = 0;
    std::string trouble;
};

Place find_stone(const StoneSource& source) {
    const double scale = std::min(
        1.0, static_cast<double>(k_search_size) / std::max(source.colour.cols, source.colour.rows));
    const Silhouette silhouette = silhouette_of(reduced(source, scale));
    Place place;
    place.trouble = silhouette.trouble;
    place.diameter = silhouette.diameter / scale;
    const cv::Rect box = cv::boundingRect(silhouette.mask);
    place.box = {static_cast<int>(std::floor(box.x / scale)),
                 static_cast<int>(std::floor(box.y / scale)),
                 static_cast<int>(std::ceil(box.width / scale)),
                 static_cast<int>(std::ceil(box.height / scale))};
    return place;
}

Cut cut_of(const Place& place, cv::Size size, double diameter) {
    const int margin = static_cast<int>(std::lround(k_margin * place.diameter)) + 2;
    Cut cut;
    cut.box = cv::Rect(place.box.x - margin, place.box.y - margin, place.box.width + 2 * margin,
                       place.box.height + 2 * margin) &
              cv::Rect({0, 0}, size);
    cut.scale = diameter / place.diameter;
    if (cut.scale > k_worth_it) cut.scale = 1;
    return cut;
}

cv::Mat bordered(const cv::Mat& picture) {
    cv::Mat result;
    const int b = k_empty_border;
    cv::copyMakeBorder(picture, result, b, b, b, b, cv::BORDER_REPLICATE);
    return result;
}

CloseUp close_up(const StoneSource& source, const Cut& cut) {
    CloseUp result;
    StoneSource part = source;
    part.colour = source.colour(cut.box);
    if (!source.coverage.empty()) part.coverage = source.coverage(cut.box);
    part = reduced(part, cut.scale);
    // The true factor differs slightly, because the reduced picture has whole pixels.
    result.scale = static_cast<double>(part.colour.cols) / cut.box.width;
    result.silhouette = silhouette_of(part);
    result.colour = bordered(part.colour);
    const int b = k_empty_border;
    cv::copyMakeBorder(result.silhouette.mask, result.silhouette.mask, b, b, b, b,
                       cv::BORDER_CONSTANT, cv::Scalar(0));
    result.silhouette.centre += cv::Point2d(b, b);
    result.corner = {cut.box.x - b / result.scale, cut.box.y - b / result.scale};
    return result;
}

cv::Mat plane_of(const std::vector<float>& values, const Photo& photo) {
    return cv::Mat(photo.height, photo.width, CV_32F, const_cast<float*>(values.data()));
}

// Ignored pixels in a close-up: every pixel that an ignored one touches.
cv::Mat ignored_in(const Photo& photo, const CloseUp& shown) {
    cv::Mat touched = plane_of(photo.ignored, photo) > 0.5f;
    if (shown.scale < 1) {
        const int reach = 2 * static_cast<int>(std::ceil(0.5 / shown.scale)) + 1;
        cv::dilate(touched, touched, cv::Mat::ones(reach, reach, CV_8U));
    }
    cv::Mat result = cv::Mat::zeros(shown.colour.size(), CV_8U);
    for (int y = 0; y < result.rows; ++y) {
        for (int x = 0; x < result.cols; ++x) {
            const cv::Point2d at = shown.in_picture(cv::Point2d(x, y));
            const int column = static_cast<int>(std::lround(at.x)),
                      row = static_cast<int>(std::lround(at.y));
            if (column < 0 || row < 0 || column >= touched.cols || row >= touched.rows) continue;
            result.at<unsigned char>(y, x) = touched.at<unsigned char>(row, column);
        }
    }
    return result;
}

// Makes a map that is within 0.001 pixels of a whole shift exactly that, so that samples are not
// mixed and a picture registered with itself stays the same.
cv::Matx23d whole_pixels(const cv::Matx23d& map, cv::Size size) {
    const cv::Matx23d whole(1, 0, std::round(map(0, 2)), 0, 1, std::round(map(1, 2)));
    const cv::Matx23d off = map - whole;
    for (const cv::Vec3d& corner :
         {cv::Vec3d(0, 0, 1), cv::Vec3d(size.width, 0, 1), cv::Vec3d(0, size.height, 1),
          cv::Vec3d(size.width, size.height, 1)}) {
        if (cv::norm(off * corner) > 1e-3) return map;
    }
    return whole;
}

Similarity in_given_pixels(const Similarity& s, const CloseUp& photo, const CloseUp& render) {
    Similarity result;
    result.scale = s.scale * photo.scale / render.scale;
    result.turn = s.turn;
    result.about = photo.in_picture(s.about);
    result.shift = render.in_picture(s(s.about)) - result.about;
    return result;
}

}  // namespace

cv::Point2d CloseUp::in_picture(const cv::Point2d& p) const {
    return {(p.x + 0.5) / scale - 0.5 + corner.x, (p.y + 0.5) / scale - 0.5 + corner.y};
}

StoneSource stone_source(const Photo& photo) {
    StoneSource source{colour_of(photo), {}, {}};
    const bool painted = !photo.mask.empty();
    const std::vector<float>& coverage = painted ? photo.mask : photo.coverage;
    // An alpha of 1 everywhere says nothing about the stone.
    const bool says_something =
        painted || std::any_of(coverage.begin(), coverage.end(), [](float c) { return c < 0.5f; });
    if (says_something) {
        source.coverage = plane_of(coverage, photo);
        source.coverage_name = painted ? "mask" : "coverage";
    }
    return source;
}

Silhouette silhouette_of(const StoneSource& source) {
    if (source.coverage.empty()) return silhouette_from_background(source.colour);
    return silhouette_from_coverage(source.coverage, source.coverage_name);
}

double stone_diameter_px(const Photo& photo) {
    const Place place = find_stone(stone_source(photo));
    return place.trouble.empty() ? place.diameter : 0;
}

Frame align(const Photo& photo, const Photo& render, double largest) {
    Frame frame;
    const StoneSource photo_source = stone_source(photo), render_source = stone_source(render);
    const Place photo_place = find_stone(photo_source), render_place = find_stone(render_source);
    frame.photo_diameter_px = photo_place.diameter;
    frame.render_diameter_px = render_place.diameter;
    if (!photo_place.trouble.empty() || !render_place.trouble.empty()) {
        frame.match.trouble = photo_place.trouble.empty() ? "render: " + render_place.trouble
                                                          : "photo: " + photo_place.trouble;
        return frame;
    }
    const double diameter = std::min({photo_place.diameter, render_place.diameter, largest});
    frame.photo = close_up(photo_source, cut_of(photo_place, photo_source.colour.size(), diameter));
    if (!photo.ignored.empty()) frame.photo.ignored = ignored_in(photo, frame.photo);
    frame.render_cut = cut_of(render_place, render_source.colour.size(), diameter);
    const CloseUp near = close_up(render_source, frame.render_cut);
    frame.render_outline = near.silhouette.source;
    frame.render_warning = near.silhouette.warning;
    frame.match = match_outlines(frame.photo.silhouette, near.silhouette);
    if (frame.match.trouble.empty() || frame.match.iou > 0) {
        frame.cut_from_photo =
            whole_pixels(matrix_of(frame.match.render_from_photo), frame.photo.colour.size());
        frame.render = resampled(near.colour, frame.cut_from_photo, frame.photo.colour.size(),
                                 Kernel::cubic, Beyond::nearest);
        frame.render_mask =
            resampled_mask(near.silhouette.mask, frame.cut_from_photo, frame.photo.colour.size());
        frame.render_from_photo = in_given_pixels(frame.match.render_from_photo, frame.photo, near);
        frame.match.residual_px /= frame.photo.scale;
        frame.match.worst_px /= frame.photo.scale;
    }
    return frame;
}

cv::Mat moved_as_render(const Frame& frame, const Photo& picture) {
    if (frame.render.empty()) return {};
    const Cut& cut = frame.render_cut;
    return resampled(bordered(reduced(colour_of(picture)(cut.box), cut.scale)),
                     frame.cut_from_photo, frame.render.size(), Kernel::cubic, Beyond::nearest);
}

}  // namespace culet
