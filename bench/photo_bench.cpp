// Measures culet photo on a long series of large JPEGs: processor time, memory, file size, and the
// error of the light. The camera moves between shots, so each has to be shifted back.
//
//     bench_photo [--shots 18] [--width 5616] [--still]

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "compare/photo/photo.h"
#include "render/colour/colour.h"
#include "stone/numbers/quantile.h"
#include "tests/scratch_folder.h"

namespace {

using namespace culet;

constexpr double k_full_well = 20000, k_read_noise = 4;  // electrons

// Stops above white: dark on the left, ten stops and more to the right, with structure of all
// sizes.
cv::Mat scene_in_stops(cv::Size size) {
    cv::RNG random(1);
    cv::Mat stops(size, CV_32F);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            stops.at<float>(y, x) = float(14.0 * x / size.width - 9);
    for (int grain = 4; grain <= 1024; grain *= 4) {
        cv::Mat coarse(size.height / grain + 3, size.width / grain + 3, CV_32F), fine;
        random.fill(coarse, cv::RNG::NORMAL, 0, 0.35);
        cv::resize(coarse, fine, size, 0, 0, cv::INTER_CUBIC);
        stops += fine;
    }
    return stops;
}

cv::Mat shot_of(const cv::Mat& stops, double exposure, cv::Point shift, std::uint64_t seed) {
    cv::RNG random(seed);
    cv::Mat shot(stops.size(), CV_8UC3);
    for (int y = 0; y < shot.rows; ++y) {
        for (int x = 0; x < shot.cols; ++x) {
            const float there = stops.at<float>(std::clamp(y - shift.y, 0, shot.rows - 1),
                                                std::clamp(x - shift.x, 0, shot.cols - 1));
            const double electrons = k_full_well * exposure * std::exp2(there);
            for (int c = 0; c < 3; ++c) {
                const double noise = std::sqrt(electrons + k_read_noise * k_read_noise);
                const double value = (electrons + random.gaussian(noise)) / k_full_well;
                shot.at<cv::Vec3b>(y, x)[c] = static_cast<unsigned char>(
                    std::lround(255 * srgb_encoded(std::clamp(value, 0.0, 1.0))));
            }
        }
    }
    return shot;
}

rusage run(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    if (status != 0) throw std::runtime_error("culet photo failed");
    return usage;
}

double seconds(const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

}  // namespace

int main(int argc, char** argv) {
    int shots = 18, width = 5616;
    bool still = false;
    CLI::App app("a series of exposures");
    app.add_option("--shots", shots);
    app.add_option("--width", width);
    app.add_flag("--still", still, "the camera was not moved");
    CLI11_PARSE(app, argc, argv);

    const test::ScratchFolder folder;
    const cv::Mat stops = scene_in_stops({width, width * 2 / 3});
    const std::string out = (folder / "out.exr").string();
    std::vector<std::string> words{CULET_PROGRAM, "photo", "-q", "-o", out}, exposures;
    for (int k = 0; k < shots; ++k) {
        const double exposure = std::exp2(4 - k);
        const cv::Point shift(still ? 0 : int(std::lround(3 * std::sin(k))),
                              still ? 0 : int(std::lround(2 * std::sin(1.7 * k))));
        words.push_back((folder / fmt::format("{}.jpg", k)).string());
        cv::imwrite(words.back(), shot_of(stops, exposure, shift, std::uint64_t(k) + 1),
                    {cv::IMWRITE_JPEG_QUALITY, 92});
        exposures.push_back(fmt::format("{}", exposure));
    }
    words.insert(words.end(), {"--exposure", fmt::format("{}", fmt::join(exposures, ","))});
    const rusage usage = run(words);

    // The scale of an estimated response is arbitrary: compare relative to the median.
    const Photo photo = read_photo(out);
    std::vector<double> off;
    for (int y = 8; y < stops.rows - 8; y += 7) {
        for (int x = 8; x < stops.cols - 8; x += 7) {
            const std::size_t i = std::size_t(y) * std::size_t(stops.cols) + std::size_t(x);
            off.push_back(std::log2(photo.rgb[3 * i + 1]) - stops.at<float>(y, x));
        }
    }
    const double middle = quantile(off, 0.5);
    for (double& stop : off) stop = std::abs(stop - middle);
    fmt::print("{} shots of {} x {} pixels{}\n", shots, stops.cols, stops.rows,
               still ? "" : ", each moved");
    fmt::print("processor time {:.1f} s, memory {:.2f} GB, file {:.0f} MB\n",
               seconds(usage.ru_utime) + seconds(usage.ru_stime), double(usage.ru_maxrss) / 1e6,
               double(std::filesystem::file_size(out)) / 1e6);
    fmt::print("light: half of the pixels within {:.3f} stops, 95 % within {:.3f}\n",
               quantile(off, 0.5), quantile(off, 0.95));
}
