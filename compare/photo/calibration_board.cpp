#include "compare/photo/calibration_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>

#include "compare/photo/pixels.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// A marker of 4 x 4 bits with its border is 6 cells wide; a square is 8.
constexpr int k_cells = 8, k_marker_cells = 6;
constexpr int k_least_corners = 8, k_least_pictures = 3;

cv::Ptr<cv::aruco::Dictionary> markers() {
    return cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_250);
}

cv::Ptr<cv::aruco::CharucoBoard> board_of(const BoardShape& shape) {
    if (shape.columns < 3 || shape.rows < 3 || shape.columns > 22 || shape.rows > 22)
        throw InputError("a board has 3 to 22 squares across and down");
    if (!(shape.square_mm > 0 && shape.square_mm < 1e4))
        throw InputError("the squares of a board are over 0 mm wide");
    return cv::aruco::CharucoBoard::create(
        shape.columns, shape.rows, static_cast<float>(shape.square_mm),
        static_cast<float>(shape.square_mm * k_marker_cells / k_cells), markers());
}

// 8-bit sRGB luminance, which the corner finder expects.
cv::Mat grey_of(const Photo& photo) {
    const cv::Mat y = luminance(colour_of(photo));
    const double white = quantile(y, {}, 0.98);
    cv::Mat grey;
    encoded(y / std::max(white, 1e-30)).convertTo(grey, CV_8U, 240);
    return grey;
}

}  // namespace

std::string board_svg(const BoardShape& shape) {
    constexpr int k_fine = 4;  // pixels per cell of the sampled picture
    cv::Mat picture;
    board_of(shape)->draw({shape.columns * k_cells * k_fine, shape.rows * k_cells * k_fine},
                          picture, 0, 1);
    const double cell = shape.square_mm / k_cells, margin = 0.5 * shape.square_mm;
    const double width = shape.columns * shape.square_mm + 2 * margin;
    const double height = shape.rows * shape.square_mm + 2 * margin + 6;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}mm\" height=\"{1:g}mm\" "
        "viewBox=\"0 0 {0:g} {1:g}\" shape-rendering=\"crispEdges\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<path fill=\"#000\" d=\"",
        width, height);
    for (int row = 0; row < shape.rows * k_cells; ++row) {
        for (int column = 0; column < shape.columns * k_cells;) {
            const auto black = [&](int c) {
                return c < shape.columns * k_cells &&
                       picture.at<unsigned char>(row * k_fine + k_fine / 2,
                                                 c * k_fine + k_fine / 2) < 128;
            };
            int end = column;
            while (black(end)) ++end;
            if (end > column) {
                svg += fmt::format("M{:g} {:g}h{:g}v{:g}h{:g}z", margin + column * cell,
                                   margin + row * cell, (end - column) * cell, cell,
                                   -(end - column) * cell);
            }
            column = std::max(end, column + 1);
        }
    }
    svg += fmt::format(
        "\"/>\n<text x=\"{:g}\" y=\"{:g}\" font-family=\"sans-serif\" font-size=\"3\">culet "
        "camera: "
        "{} x {} squares of {:g} mm; print at 100 %, measure a square, glue it "
        "flat</text>\n</svg>\n",
        margin, height - 3, shape.columns, shape.rows, shape.square_mm);
    return svg;
}

LensCalibration calibrate_lens(const std::vector<std::filesystem::path>& pictures,
                               const BoardShape& shape, const Progress& progress) {
    if (pictures.empty()) throw InputError("name the photographs of the board");
    const auto board = board_of(shape);
    LensCalibration result;
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<std::vector<int>> ids;
    std::vector<std::size_t> used;
    std::set<std::string> told;  // the pictures' notes, each once
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (progress &&
            !progress(static_cast<double>(i) / static_cast<double>(pictures.size() + 1)))
            throw Interrupted();
        const Photo photo = read_photo(pictures[i]);
        for (const std::string& note : photo.notes) {
            if (told.insert(note).second)
                result.notes.push_back(fmt::format("{}: {}", pictures[i].string(), note));
        }
        if (i == 0) {
            result.lens.width = photo.width;
            result.lens.height = photo.height;
        } else if (photo.width != result.lens.width || photo.height != result.lens.height) {
            throw InputError(
                pictures[i],
                fmt::format("is {} x {} pixels, the first is {} x {}: hold the camera "
                            "the same way round, and do not cut pictures",
                            photo.width, photo.height, result.lens.width, result.lens.height));
        }
        const cv::Mat grey = grey_of(photo);
        std::vector<std::vector<cv::Point2f>> marker_corners, rejected;
        std::vector<int> marker_ids;
        const auto parameters = cv::aruco::DetectorParameters::create();
        cv::Mat found_corners, found_ids;
        try {
            cv::aruco::detectMarkers(grey, markers(), marker_corners, marker_ids, parameters,
                                     rejected);
            if (!marker_ids.empty()) {
                cv::aruco::interpolateCornersCharuco(marker_corners, marker_ids, grey, board,
                                                     found_corners, found_ids);
            }
        } catch (const cv::Exception&) {
            found_ids.release();
        }
        result.pictures.push_back({pictures[i].string(), static_cast<int>(found_ids.total()), 0});
        if (static_cast<int>(found_ids.total()) < k_least_corners) continue;
        corners.emplace_back(found_corners.begin<cv::Point2f>(), found_corners.end<cv::Point2f>());
        ids.emplace_back(found_ids.begin<int>(), found_ids.end<int>());
        used.push_back(i);
    }
    for (const BoardPicture& picture : result.pictures) {
        if (picture.corners < k_least_corners) {
            result.notes.push_back(
                fmt::format("{}: left out, only {} corners of the board were found", picture.name,
                            picture.corners));
        }
    }
    if (static_cast<int>(used.size()) < k_least_pictures) {
        throw InputError(fmt::format(
            "{} of {} photographs show the board of {} x {} squares (at least {} must): is it the "
            "one that culet camera --board wrote, sharp, whole and evenly lit? --columns, --rows "
            "say otherwise",
            used.size(), pictures.size(), shape.columns, shape.rows, k_least_pictures));
    }
    cv::Mat camera, distortion, sigma, sigma_poses, per_view;
    std::vector<cv::Mat> turns, places;
    double residual = 0;
    try {
        residual = cv::aruco::calibrateCameraCharuco(
            corners, ids, board, {result.lens.width, result.lens.height}, camera, distortion, turns,
            places, sigma, sigma_poses, per_view,
            used.size() < 6 ? cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST : 0);
    } catch (const cv::Exception&) {
        throw InputError(
            "the photographs of the board do not determine a lens: take more, tilted by 20 to 40 "
            "degrees in several directions");
    }
    Lens& lens = result.lens;
    lens.focal_x = camera.at<double>(0, 0);
    lens.focal_y = camera.at<double>(1, 1);
    lens.principal_x = camera.at<double>(0, 2);
    lens.principal_y = camera.at<double>(1, 2);
    for (int k = 0; k < 5 && k < static_cast<int>(distortion.total()); ++k)
        lens.distortion[static_cast<std::size_t>(k)] = distortion.at<double>(k);
    lens.residual_px = residual;
    lens.pictures = static_cast<int>(used.size());
    result.focal_sigma_px = sigma.at<double>(0);
    result.principal_sigma_px = std::max(sigma.at<double>(2), sigma.at<double>(3));
    double steepest = 0;
    for (std::size_t k = 0; k < used.size(); ++k) {
        result.pictures[used[k]].residual_px = per_view.at<double>(static_cast<int>(k));
        cv::Matx33d rotation;
        cv::Rodrigues(turns[k], rotation);
        steepest = std::max(steepest, std::acos(std::clamp(std::abs(rotation(2, 2)), 0.0, 1.0)));
    }
    const double degree = 0.017453292519943295;
    if (!(std::isfinite(residual) && lens.focal_x > 0 && lens.focal_y > 0)) {
        throw InputError("the photographs of the board do not determine a lens: take more, tilted");
    }
    if (residual > 1) {
        result.doubt = fmt::format(
            "the corners are off by {:.1f} pixels: is the board flat, are "
            "the pictures sharp, was the zoom or focus changed?",
            residual);
    } else if (steepest < 10 * degree) {
        result.doubt =
            "the board was never tilted by 10 degrees: its size and its distance cannot "
            "be told apart, and the focal length is a guess";
    }
    return result;
}

}  // namespace culet
