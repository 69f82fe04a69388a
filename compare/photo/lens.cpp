#include "compare/photo/lens.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "stone/text/errors.h"
#include "stone/text/toml_file.h"

namespace culet {

Lens read_lens(const std::filesystem::path& file) {
    const TomlTable root = read_toml(file);
    const auto table = root.table("lens");
    if (!table) {
        throw InputError(file,
                         "is not a camera file: it has no table [lens] (culet camera writes one)");
    }
    table->refuse_unknown(
        {"size", "focal_px", "principal_px", "distortion", "residual_px", "pictures", "camera"});
    const auto numbers = [&](const char* key, std::size_t count) {
        const auto values = table->numbers(key);
        if (!values || values->size() != count)
            table->fail(key, fmt::format("{} needs {} numbers", key, count));
        return *values;
    };
    Lens lens;
    const auto size = numbers("size", 2), focal = numbers("focal_px", 2),
               principal = numbers("principal_px", 2), distortion = numbers("distortion", 5);
    if (!(size[0] >= 1 && size[1] >= 1 && size[0] <= 1e6 && size[1] <= 1e6))
        table->fail("size", "size is the width and height of the pictures in pixels");
    if (!(focal[0] > 0 && focal[1] > 0)) table->fail("focal_px", "focal lengths are over 0");
    lens.width = static_cast<int>(size[0]);
    lens.height = static_cast<int>(size[1]);
    lens.focal_x = focal[0];
    lens.focal_y = focal[1];
    lens.principal_x = principal[0];
    lens.principal_y = principal[1];
    std::copy(distortion.begin(), distortion.end(), lens.distortion.begin());
    lens.residual_px = table->number("residual_px").value_or(0);
    lens.pictures = static_cast<int>(table->integer("pictures").value_or(0));
    return lens;
}

std::string lens_toml(const Lens& lens, const std::string& camera) {
    std::string name;
    for (const char c : camera) name += c == '"' || c == '\\' ? ' ' : c;
    return fmt::format(
        "# A camera's geometry, by culet camera. Pixels; the centre of the first is at 0, 0.\n"
        "[lens]\n{}size = [{}, {}]\nfocal_px = [{:.4f}, {:.4f}]\nprincipal_px = [{:.4f}, {:.4f}]\n"
        "distortion = [{:.9g}, {:.9g}, {:.9g}, {:.9g}, {:.9g}]  # k1, k2, p1, p2, k3\n"
        "residual_px = {:.4f}\npictures = {}\n",
        name.empty() ? "" : fmt::format("camera = \"{}\"\n", name), lens.width, lens.height,
        lens.focal_x, lens.focal_y, lens.principal_x, lens.principal_y, lens.distortion[0] + 0.0,
        lens.distortion[1] + 0.0, lens.distortion[2] + 0.0, lens.distortion[3] + 0.0,
        lens.distortion[4] + 0.0, lens.residual_px, lens.pictures);
}

Lens lens_for(const Lens& lens, int width, int height, const std::filesystem::path& file) {
    const double sx = static_cast<double>(width) / lens.width;
    const double sy = static_cast<double>(height) / lens.height;
    if (std::abs(sx / sy - 1) > 0.005) {
        throw InputError(file, fmt::format("is {} x {} pixels, the camera file is for {} x {}: a "
                                           "picture that was cut or turned does not fit it",
                                           width, height, lens.width, lens.height));
    }
    Lens scaled = lens;
    scaled.width = width;
    scaled.height = height;
    scaled.focal_x *= sx;
    scaled.focal_y *= sy;
    // Pixel edges scale; centres are half a pixel from them.
    scaled.principal_x = (lens.principal_x + 0.5) * sx - 0.5;
    scaled.principal_y = (lens.principal_y + 0.5) * sy - 0.5;
    return scaled;
}

void undistort(Photo& photo, const Lens& lens) {
    const cv::Matx33d camera(lens.focal_x, 0, lens.principal_x, 0, lens.focal_y, lens.principal_y,
                             0, 0, 1);
    const cv::Mat distortion(1, 5, CV_64F, const_cast<double*>(lens.distortion.data()));
    cv::Mat map_x, map_y;
    cv::initUndistortRectifyMap(camera, distortion, cv::noArray(), camera,
                                {photo.width, photo.height}, CV_32FC1, map_x, map_y);
    const auto remapped = [&](std::vector<float>& values, int channels, int how) {
        if (values.empty()) return;
        const cv::Mat from(photo.height, photo.width, CV_32FC(channels), values.data());
        cv::Mat to;
        cv::remap(from, to, map_x, map_y, how, cv::BORDER_CONSTANT);
        const auto* first = to.ptr<float>();
        values.assign(first, first + to.total() * static_cast<std::size_t>(channels));
    };
    remapped(photo.rgb, 3, cv::INTER_LINEAR);
    remapped(photo.variance, 3, cv::INTER_LINEAR);
    remapped(photo.saturated, 1, cv::INTER_LINEAR);
    remapped(photo.coverage, 1, cv::INTER_LINEAR);
}

}  // namespace culet
