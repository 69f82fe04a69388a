#include "tests/render/golden/golden_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/image/image_exr.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "stone/text/errors.h"

namespace culet::test {

namespace {

constexpr int k_side = 40;
constexpr double k_tolerance = 0.05;
// Relative to the mean radiance: a fifth of the tolerance. The tolerance permits smaller
// differences, and other processors may round a ray at an edge to the other side.
constexpr double k_floor = k_tolerance / 5;

}  // namespace

double mean_radiance(const Picture& picture) {
    double sum = 0;
    for (const float value : picture.rgb) sum += value;
    return sum / static_cast<double>(picture.rgb.size());
}

std::vector<std::string> golden_scenes() {
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(CULET_SOURCE_DIR "/samples/effects")) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

Picture drawn(const std::string& scene, const std::string& engine, std::uint64_t seed) {
    const std::string file = CULET_SOURCE_DIR "/samples/effects/" + scene + ".toml";
    Scene read = read_scene(file, {fmt::format("camera.size=[{0},{0}]", k_side)});
    read.settings.engine = engine;
    read.settings.tolerance = k_tolerance;
    read.settings.seed = seed;
    return render(read).picture;
}

GoldenPicture golden_of(const std::vector<Picture>& pictures) {
    const auto of = [&](std::size_t left_out) {
        GoldenPicture golden;
        golden.mean = pictures.front();
        golden.variance.assign(golden.mean.rgb.size(), 0);
        golden.count = static_cast<int>(pictures.size()) - (left_out < pictures.size() ? 1 : 0);
        for (std::size_t i = 0; i < golden.variance.size(); ++i) {
            double sum = 0, squares = 0;
            for (std::size_t k = 0; k < pictures.size(); ++k) {
                if (k == left_out) continue;
                const double value = pictures[k].rgb[i];
                sum += value;
                squares += value * value;
            }
            const double n = golden.count;
            golden.mean.rgb[i] = static_cast<float>(sum / n);
            golden.variance[i] =
                static_cast<float>(std::max(squares - sum * sum / n, 0.0) / (n - 1));
        }
        return golden;
    };
    GoldenPicture golden = of(pictures.size());
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < pictures.size(); ++k) {
        const double ratio = squared_difference(pictures[k], of(k));
        sum += ratio;
        squares += ratio * ratio;
    }
    const auto n = static_cast<double>(pictures.size());
    golden.ratio_mean = sum / n;
    golden.ratio_sigma = std::sqrt(std::max(squares - sum * sum / n, 0.0) / (n - 1));
    return golden;
}

double squared_difference(const Picture& picture, const GoldenPicture& golden) {
    check(picture.rgb.size() == golden.mean.rgb.size(), "pictures of one size");
    const double floor = k_floor * mean_radiance(golden.mean);
    double squares = 0, expected = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double off = double(picture.rgb[i]) - double(golden.mean.rgb[i]);
        // The mean of `count` pictures has its own variance.
        const double variance = golden.variance[i] * (1 + 1.0 / golden.count) + floor * floor;
        squares += off * off;
        expected += variance;
    }
    return squares / expected;
}

std::filesystem::path golden_file(const std::string& scene, const std::string& engine) {
    return fmt::format(CULET_SOURCE_DIR "/tests/render/golden/{}-{}.exr", scene, engine);
}

void write_golden(const GoldenPicture& golden, const std::filesystem::path& file) {
    Picture picture = golden.mean;
    picture.planes.clear();
    picture.coverage.clear();
    picture.standard_error.clear();
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> plane(picture.pixels());
        for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = golden.variance[3 * i + c];
        picture.planes.push_back({k_variance_channels[c], std::move(plane)});
    }
    write_picture(picture, file, {},
                  {{"culet:count", fmt::format("{}", golden.count)},
                   {"culet:ratio_mean", fmt::format("{:.6g}", golden.ratio_mean)},
                   {"culet:ratio_sigma", fmt::format("{:.6g}", golden.ratio_sigma)}});
}

GoldenPicture read_golden(const std::filesystem::path& file) {
    GoldenPicture golden;
    golden.mean = read_picture(file).picture;
    golden.variance.resize(golden.mean.rgb.size());
    for (std::size_t c = 0; c < 3; ++c) {
        const auto plane = std::find_if(
            golden.mean.planes.begin(), golden.mean.planes.end(),
            [&](const Picture::Plane& one) { return one.channel == k_variance_channels[c]; });
        check(plane != golden.mean.planes.end(), "a golden picture has its variance");
        for (std::size_t i = 0; i < golden.mean.pixels(); ++i)
            golden.variance[3 * i + c] = plane->values[i];
    }
    for (const auto& [key, value] : golden.mean.text) {
        if (key == "culet:count") golden.count = std::stoi(value);
        if (key == "culet:ratio_mean") golden.ratio_mean = std::stod(value);
        if (key == "culet:ratio_sigma") golden.ratio_sigma = std::stod(value);
    }
    return golden;
}

}  // namespace culet::test
