#include "render/reference/film.h"

#include <cmath>
#include <utility>

#include "render/optics/eye_optics.h"

namespace culet {

Film::Film(const Scene& scene, const Camera& camera, const OpticalSetup& setup,
           const WavelengthSet& colours, int planes)
    : colours_(colours),
      windows_(camera.optics.two_windows ? 2 : 1),
      width_(camera.width),
      planes_(planes),
      nodes_(colours.size()) {
    picture_.width = windows_ * width_;
    picture_.height = camera.height;
    picture_.rgb.resize(3 * picture_.pixels());
    picture_.coverage.resize(picture_.pixels());
    if (setup.general) picture_.standard_error.resize(picture_.pixels());
    if (scene.settings.spectral) {
        picture_.wavelengths_nm = setup.wavelengths_nm;
        picture_.spectral.assign(nodes_, std::vector<float>(picture_.pixels()));
        if (planes == 4 && windows_ == 1) picture_.polarised.fill(picture_.spectral);
    }
    for (int window = 0; window < windows_; ++window) {
        for (double nm : setup.wavelengths_nm) rows_.push_back(response(camera.optics, nm, window));
    }
}

void Film::put(int x, int y, const PixelSums& sums, const double* estimates) {
    // In dark pixels, random paths may estimate unphysical light. Pictures without a standard error
    // have no random paths.
    std::vector<double> nearest;
    if (!picture_.standard_error.empty()) {
        nearest.resize(static_cast<std::size_t>(planes_ * nodes_));
        for (int i = 0; i < nodes_; ++i) {
            Stokes seen{};
            for (int k = 0; k < planes_; ++k) seen[k] = estimates[k * nodes_ + i];
            seen = nearest_light(seen);
            for (int k = 0; k < planes_; ++k) nearest[k * nodes_ + i] = seen[k];
        }
    }
    const double* stokes = nearest.empty() ? estimates : nearest.data();
    // S0 alone is the radiance: there are no optics before the eye.
    std::vector<double> behind_optics(planes_ > 1 ? nodes_ : 0);
    const double* radiance = planes_ > 1 ? behind_optics.data() : stokes;
    for (int window = 0; window < windows_; ++window) {
        const std::size_t pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
            static_cast<std::size_t>(x + window * width_);
        for (int i = 0; planes_ > 1 && i < nodes_; ++i) {
            behind_optics[i] = 0;
            for (int k = 0; k < planes_; ++k)
                behind_optics[i] += rows_[window * nodes_ + i][k] * stokes[k * nodes_ + i];
        }
        const Rgb rgb = colours_.rgb_of(radiance);
        for (int c = 0; c < 3; ++c) picture_.rgb[3 * pixel + c] = static_cast<float>(rgb[c]);
        picture_.coverage[pixel] = static_cast<float>(sums.hit);
        if (!picture_.standard_error.empty())
            picture_.standard_error[pixel] = static_cast<float>(std::sqrt(sums.variance));
        if (picture_.spectral.empty()) continue;
        for (int i = 0; i < nodes_; ++i) {
            picture_.spectral[i][pixel] = static_cast<float>(radiance[i]);
            for (int k = 0; k < 3 && !picture_.polarised[k].empty(); ++k)
                picture_.polarised[k][i][pixel] = static_cast<float>(stokes[(k + 1) * nodes_ + i]);
        }
    }
}

Picture Film::take(bool noisy) {
    if (!noisy) picture_.standard_error.clear();
    return std::move(picture_);
}

}  // namespace culet
