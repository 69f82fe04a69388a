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
#include "stone/numbers/units.h"
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

using Board = cv::Ptr<cv::aruco::CharucoBoard>;

/// The corners found, and their numbers, of the pictures that show enough of them.
struct SeenBoards {
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<std::vector<int>> ids;
    std::vector<std::size_t> pictures;
};

void require_same_size(const std::filesystem::path& file, const Photo& photo, const Lens& lens) {
    if (photo.width == lens.width && photo.height == lens.height) return;
    throw InputError(file, fmt::format("is {} x {} pixels, the first is {} x {}: hold the camera "
                                       "the same way round, and do not cut pictures",
                                       photo.width, photo.height, lens.width, lens.height));
}

// Returns the number of corners found.
int find_corners(const cv::Mat& grey, const Board& board, std::size_t picture, SeenBoards& seen) {
    std::vector<std::vector<cv::Point2f>> marker_corners, rejected;
    std::vector<int> marker_ids;
    const auto parameters = cv::aruco::DetectorParameters::create();
    cv::Mat corners, ids;
    try {
        cv::aruco::detectMarkers(grey, markers(), marker_corners, marker_ids, parameters, rejected);
        if (!marker_ids.empty()) {
            cv::aruco::interpolateCornersCharuco(marker_corners, marker_ids, grey, board, corners,
                                                 ids);
        }
    } catch (const cv::Exception&) {
        ids.release();
    }
    const int count = static_cast<int>(ids.total());
    if (count < k_least_corners) return count;
    seen.corners.emplace_back(corners.begin<cv::Point2f>(), corners.end<cv::Point2f>());
    seen.ids.emplace_back(ids.begin<int>(), ids.end<int>());
    seen.pictures.push_back(picture);
    return count;
}

// Reads the pictures; sets their size and notes.
SeenBoards boards_in(const std::vector<std::filesystem::path>& pictures, const Board& board,
                     const Progress& progress, LensCalibration& result) {
    SeenBoards seen;
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
        }
        require_same_size(pictures[i], photo, result.lens);
        const int corners = find_corners(grey_of(photo), board, i, seen);
        result.pictures.push_back({pictures[i].string(), corners, 0});
    }
    for (const BoardPicture& picture : result.pictures) {
        if (picture.corners < k_least_corners) {
            result.notes.push_back(
                fmt::format("{}: left out, only {} corners of the board were found", picture.name,
                            picture.corners));
        }
    }
    return seen;
}

// Sets the lens, the sigmas and the pictures' residuals; returns the board's steepest tilt,
// radians.
double solve_lens(const SeenBoards& seen, const Board& board, LensCalibration& result) {
    Lens& lens = result.lens;
    cv::Mat camera, distortion, sigma, sigma_poses, per_view;
    std::vector<cv::Mat> turns, places;
    try {
        lens.residual_px = cv::aruco::calibrateCameraCharuco(
            seen.corners, seen.ids, board, {lens.width, lens.height}, camera, distortion, turns,
            places, sigma, sigma_poses, per_view,
            seen.pictures.size() < 6 ? cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST : 0);
    } catch (const cv::Exception&) {
        throw InputError(
            "the photographs of the board do not determine a lens: take more, tilted by 20 to 40 "
            "degrees in several directions");
    }
    lens.focal_x = camera.at<double>(0, 0);
    lens.focal_y = camera.at<double>(1, 1);
    lens.principal_x = camera.at<double>(0, 2);
    lens.principal_y = camera.at<double>(1, 2);
    for (int k = 0; k < 5 && k < static_cast<int>(distortion.total()); ++k)
        lens.distortion[static_cast<std::size_t>(k)] = distortion.at<double>(k);
    lens.pictures = static_cast<int>(seen.pictures.size());
    result.focal_sigma_px = sigma.at<double>(0);
    result.principal_sigma_px = std::max(sigma.at<double>(2), sigma.at<double>(3));
    double steepest = 0;
    for (std::size_t k = 0; k < seen.pictures.size(); ++k) {
        result.pictures[seen.pictures[k]].residual_px = per_view.at<double>(static_cast<int>(k));
        cv::Matx33d rotation;
        cv::Rodrigues(turns[k], rotation);
        steepest = std::max(steepest, std::acos(std::clamp(std::abs(rotation(2, 2)), 0.0, 1.0)));
    }
    return steepest;
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
    const Board board = board_of(shape);
    LensCalibration result;
    const SeenBoards seen = boards_in(pictures, board, progress, result);
    if (static_cast<int>(seen.pictures.size()) < k_least_pictures) {
        throw InputError(fmt::format(
            "{} of {} photographs show the board of {} x {} squares (at least {} must): is it the "
            "one that culet camera --board wrote, sharp, whole and evenly lit? --columns, --rows "
            "say otherwise",
            seen.pictures.size(), pictures.size(), shape.columns, shape.rows, k_least_pictures));
    }
    const double steepest = solve_lens(seen, board, result);
    const double residual = result.lens.residual_px;
    if (!(std::isfinite(residual) && result.lens.focal_x > 0 && result.lens.focal_y > 0)) {
        throw InputError("the photographs of the board do not determine a lens: take more, tilted");
    }
    if (residual > 1) {
        result.doubt = fmt::format(
            "the corners are off by {:.1f} pixels: is the board flat, are "
            "the pictures sharp, was the zoom or focus changed?",
            residual);
    } else if (steepest < radians(10.0)) {
        result.doubt =
            "the board was never tilted by 10 degrees: its size and its distance cannot "
            "be told apart, and the focal length is a guess";
    }
    return result;
}

}  // namespace culet
