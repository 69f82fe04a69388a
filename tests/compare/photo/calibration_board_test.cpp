// The board and the lens. Expectation: the camera with which the board was projected.

#include "compare/photo/calibration_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// The printed page from the SVG's path: rectangles of whole cells.
cv::Mat page_of(const std::string& svg, double pixels_per_mm, double width_mm, double height_mm) {
    cv::Mat page(cvRound(height_mm * pixels_per_mm), cvRound(width_mm * pixels_per_mm), CV_8U,
                 cv::Scalar(235));
    const std::size_t from = svg.find(" d=\"") + 4;
    std::string path = svg.substr(from, svg.find('"', from) - from);
    for (char& c : path)
        if (std::isalpha(static_cast<unsigned char>(c)) != 0) c = ' ';
    std::istringstream stream(path);
    double x = 0, y = 0, w = 0, h = 0, back = 0;
    while (stream >> x >> y >> w >> h >> back) {
        cv::rectangle(
            page,
            cv::Rect(cv::Point(cvRound(x * pixels_per_mm), cvRound(y * pixels_per_mm)),
                     cv::Point(cvRound((x + w) * pixels_per_mm), cvRound((y + h) * pixels_per_mm))),
            cv::Scalar(20), cv::FILLED);
    }
    return page;
}

class Boards : public test::FolderTest {};

TEST_F(Boards, TheLensThatTookThemIsFound) {
    const BoardShape shape{7, 5, 20};
    const double scale = 8, width_mm = 7 * 20 + 20, height_mm = 5 * 20 + 26;
    const cv::Mat page = page_of(board_svg(shape), scale, width_mm, height_mm);
    const double f = 900, cx = 322.5, cy = 236;
    const cv::Matx33d camera(f, 0, cx, 0, f, cy, 0, 0, 1);
    const cv::Mat distortion = (cv::Mat_<double>(1, 5) << -0.12, 0.05, 0, 0, 0);
    std::vector<fs::path> files;
    const double tilts[][3] = {{0.5, 0.1, 0},   {-0.5, 0.2, 0.1},  {0.1, 0.55, 0.3},
                               {0.05, -0.5, 0}, {0.35, 0.35, 0.6}, {-0.3, -0.4, -0.4},
                               {0.1, 0.05, 0},  {-0.45, 0.45, 1.2}};
    for (const auto& tilt : tilts) {
        cv::Matx33d turn;
        cv::Rodrigues(cv::Vec3d(tilt[0], tilt[1], tilt[2]), turn);
        const cv::Vec3d middle(width_mm / 2, height_mm / 2, 0);
        const cv::Vec3d place = cv::Vec3d(0, 0, 290) - turn * middle;
        // Maps each pixel through the lens back onto the page; 2 x 2 samples per pixel.
        cv::Mat big(960, 1280, CV_8U, cv::Scalar(120));
        std::vector<cv::Point2d> pixels, rays;
        for (int y = 0; y < big.rows; ++y)
            for (int x = 0; x < big.cols; ++x)
                pixels.emplace_back((x + 0.5) / 2 - 0.5, (y + 0.5) / 2 - 0.5);
        cv::undistortPoints(pixels, rays, camera, distortion);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            // Solves place + a r1 + b r2 = t ray.
            const cv::Vec3d ray(rays[i].x, rays[i].y, 1);
            const cv::Vec3d n(turn(0, 2), turn(1, 2), turn(2, 2));
            const double t = n.dot(place) / n.dot(ray);
            const cv::Vec3d on = turn.t() * (t * ray - place);
            const int px = cvFloor(on[0] * scale), py = cvFloor(on[1] * scale);
            if (px >= 0 && py >= 0 && px < page.cols && py < page.rows)
                big.data[i] = page.at<unsigned char>(py, px);
        }
        cv::Mat picture;
        cv::resize(big, picture, {640, 480}, 0, 0, cv::INTER_AREA);
        files.push_back(folder_ / ("board" + std::to_string(files.size()) + ".png"));
        cv::imwrite(files.back().string(), picture);
    }
    const LensCalibration found = calibrate_lens(files, shape);
    EXPECT_TRUE(found.doubt.empty()) << found.doubt;
    EXPECT_EQ(found.lens.pictures, static_cast<int>(files.size()));
    EXPECT_NEAR(found.lens.focal_x / f, 1, 0.01);
    EXPECT_NEAR(found.lens.focal_y / f, 1, 0.01);
    EXPECT_NEAR(found.lens.principal_x, cx, 5);
    EXPECT_NEAR(found.lens.principal_y, cy, 5);
    // The boards extend to about 0.24 from the axis. Single coefficients are correlated; what
    // counts is where a ray meets the picture.
    for (const double r : {0.1, 0.15, 0.2}) {
        const double r2 = r * r;
        const auto& d = found.lens.distortion;
        EXPECT_NEAR(f * r * (r2 * (d[0] + r2 * (d[1] + r2 * d[4]))),
                    f * r * r2 * (-0.12 + 0.05 * r2), 0.7);
    }
    EXPECT_LT(found.lens.residual_px, 0.4);

    const fs::path file = folder_ / "camera.toml";
    std::ofstream(file) << lens_toml(found.lens, "a \"camera\"");
    const Lens again = read_lens(file);
    EXPECT_NEAR(again.focal_x, found.lens.focal_x, 1e-3);
    EXPECT_NEAR(again.distortion[0], found.lens.distortion[0], 1e-8);
    EXPECT_NEAR(lens_for(again, 320, 240, "a.png").focal_x, again.focal_x / 2, 1e-9);
    EXPECT_THROW(lens_for(again, 480, 640, "a.png"), InputError);
}

TEST_F(Boards, PicturesWithoutTheBoardAreRefused) {
    const fs::path file = folder_ / "a.png";
    cv::imwrite(file.string(), cv::Mat(120, 160, CV_8UC3, cv::Scalar(40, 80, 120)));
    try {
        calibrate_lens({file, file, file}, {});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("0 of 3 photographs show the board"));
    }
    EXPECT_THROW(calibrate_lens({}, {}), InputError);
    EXPECT_THROW(board_svg({2, 2, 10}), InputError);
    EXPECT_THROW(board_svg({7, 5, -1}), InputError);
}

TEST(Lens, DistortionIsTakenOut) {
    Lens lens;
    lens.width = 200;
    lens.height = 150;
    lens.focal_x = lens.focal_y = 220;
    lens.principal_x = 99.5;
    lens.principal_y = 74.5;
    lens.distortion = {-0.2, 0, 0, 0, 0};
    Photo photo;
    photo.width = 200;
    photo.height = 150;
    photo.rgb.assign(3 * 200 * 150, 0.0f);
    // A vertical line at x = 0.3 in front of the lens, as the lens draws it.
    for (double v = -0.34; v < 0.34; v += 0.0005) {
        const double u = 0.3, r2 = u * u + v * v, bend = 1 - 0.2 * r2;
        const int x = cvRound(99.5 + 220 * u * bend), y = cvRound(74.5 + 220 * v * bend);
        if (x >= 0 && y >= 0 && x < 200 && y < 150)
            for (std::size_t c = 0; c < 3; ++c)
                photo.rgb[3 * (static_cast<std::size_t>(y) * 200 + x) + c] = 1;
    }
    undistort(photo, lens);
    for (int y = 10; y < 140; y += 5) {
        double sum = 0, at = 0;
        for (int x = 140; x < 200; ++x) {
            const double v = photo.rgb[3 * (static_cast<std::size_t>(y) * 200 + x)];
            sum += v;
            at += v * x;
        }
        ASSERT_GT(sum, 0.2);
        EXPECT_NEAR(at / sum, 99.5 + 220 * 0.3, 0.8) << y;
    }
}

}  // namespace
}  // namespace culet
