#include "bench/reference_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "render/render.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

std::string numbers(const Vec3& v) {
    return fmt::format("{:a} {:a} {:a};", v.x, v.y, v.z);
}

// Everything in which these scenes differ.
std::string key_of(const Scene& scene, int samples) {
    const RenderSettings& s = scene.settings;
    const Camera& camera = scene.camera;
    std::string key = fmt::format("samples {} depth {} size {} {} fov {:a} pupil {:a} {:a};",
                                  samples, s.depth, camera.width, camera.height, camera.fov,
                                  camera.aperture_radius, camera.focus_distance);
    key += numbers(camera.position) + numbers(camera.look_at) + numbers(camera.up);
    for (const bool effect : s.effects) key += effect ? '1' : '0';
    for (const double nm : s.wavelengths_nm)
        key += fmt::format(" {:a} {:a}", nm, scene.stone.material.index[0].at(nm));
    for (const Facet& facet : scene.stone.solid.facets)
        key += numbers(facet.plane.normal) + fmt::format("{:a};", facet.plane.offset);
    key += fmt::format("constant {:a}", scene.lights.constant);
    for (const CosinePowerLight& lobe : lights_of_type<CosinePowerLight>(scene.lights))
        key += numbers(lobe.direction) +
               fmt::format("{:a} {:a};", lobe.exponent, std::get<double>(lobe.radiance.value));
    return key;
}

// FNV-1a, 64 bits.
std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return hash;
}

bool read_floats(const std::filesystem::path& file, std::vector<float>& values) {
    std::ifstream in(file, std::ios::binary);
    const auto bytes = static_cast<std::streamsize>(values.size() * sizeof(float));
    return in.read(reinterpret_cast<char*>(values.data()), bytes) && in.peek() == EOF;
}

void write_floats(const std::filesystem::path& file, const std::vector<float>& values) {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(float)));
    if (!out.flush()) throw InputError(file.string() + ": cannot be written");
}

}  // namespace

double Difference::psnr() const {
    return rmse > 0 ? 20 * std::log10(peak / rmse) : std::numeric_limits<double>::infinity();
}

Difference difference(const Picture& picture, const Picture& reference) {
    check(picture.rgb.size() == reference.rgb.size(), "pictures are of one size");
    Difference d;
    double squares = 0, stone = 0;
    for (const float v : reference.rgb) {
        d.peak = std::max(d.peak, static_cast<double>(v));
        d.mean += static_cast<double>(v);
    }
    for (std::size_t i = 0; i < reference.pixels(); ++i) {
        double most = 0;
        Rgb error{};
        for (std::size_t c = 0; c < 3; ++c) {
            error[c] = static_cast<double>(picture.rgb[3 * i + c]) -
                       static_cast<double>(reference.rgb[3 * i + c]);
            const double e = std::abs(error[c]);
            // Also true for NaN.
            if (!(e <= most)) most = e;
            squares += e * e;
        }
        if (!picture.coverage.empty() && picture.coverage[i] > 0) {
            d.of_stone += std::abs(luminance(error));
            ++stone;
        }
        d.off += !(most <= 1e-3 * d.peak);
    }
    const double values = static_cast<double>(reference.rgb.size());
    d.rmse = std::sqrt(squares / values);
    d.mean /= values;
    if (stone > 0) d.of_stone /= stone;
    return d;
}

const Picture& ReferencePictures::at(const Scene& scene, int samples) {
    const std::string key = key_of(scene, samples);
    const auto found = drawn_.find(key);
    if (found != drawn_.end()) return found->second;
    Picture& picture = drawn_[key];
    picture.width = scene.camera.width;
    picture.height = scene.camera.height;
    picture.rgb.resize(3 * picture.pixels());
    const std::filesystem::path file =
        cache_.empty() ? cache_ : cache_ / fmt::format("{:016x}.floats", hash_of(key));
    if (!file.empty() && read_floats(file, picture.rgb)) return picture;
    Scene reference = scene;
    reference.settings.engine = "reference";
    reference.settings.samples = samples;
    reference.settings.threads = 0;
    picture = render(reference).picture;
    if (!file.empty()) write_floats(file, picture.rgb);
    return picture;
}

}  // namespace culet
