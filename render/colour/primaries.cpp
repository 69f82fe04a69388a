#include "render/colour/primaries.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "render/colour/colour.h"

namespace culet {

namespace {

bool same_colours(const Primaries& a, const Primaries& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
            if (!(std::abs(a[i][k] - b[i][k]) <= 5e-4))
                return false;  // files round to three digits
        }
    }
    return true;
}

glm::dvec3 xyz_at(const std::array<double, 2>& xy) {
    return {xy[0], xy[1], 1 - xy[0] - xy[1]};
}

// Bradford cone responses (Lam 1985; ICC.1:2010, annex E.3).
glm::dmat3 adapted(const glm::dvec3& from_white, const glm::dvec3& to_white) {
    const glm::dmat3 cone = glm::transpose(
        glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dvec3 ratio = (cone * to_white) / (cone * from_white);
    const glm::dmat3 scaled(ratio.x, 0, 0, 0, ratio.y, 0, 0, 0, ratio.z);
    return glm::inverse(cone) * scaled * cone;
}

}  // namespace

std::optional<std::array<double, 9>> srgb_from(const Primaries& primaries) {
    glm::dmat3 to_xyz(1);
    if (!same_colours(primaries, k_xyz_primaries)) {
        const glm::dmat3 chromatic(xyz_at(primaries[0]), xyz_at(primaries[1]),
                                   xyz_at(primaries[2]));
        const glm::dvec3 white = xyz_at(primaries[3]) / primaries[3][1];
        const double span = glm::determinant(chromatic);
        if (!std::isfinite(span) || std::abs(span) < 1e-6 || !(primaries[3][1] > 1e-3) ||
            !std::isfinite(white.x))
            return std::nullopt;
        const glm::dvec3 share = glm::inverse(chromatic) * white;
        const glm::dmat3 scaled(share.x, 0, 0, 0, share.y, 0, 0, 0, share.z);
        const auto d65 = xyz_of_rgb({1, 1, 1});
        to_xyz = adapted(white, {d65[0], d65[1], d65[2]}) * chromatic * scaled;
    }
    std::array<double, 9> matrix{};
    for (int c = 0; c < 3; ++c) {
        const Rgb rgb = rgb_of_xyz({to_xyz[c].x, to_xyz[c].y, to_xyz[c].z});
        for (std::size_t r = 0; r < 3; ++r) {
            if (!std::isfinite(rgb[r])) return std::nullopt;
            matrix[3 * r + static_cast<std::size_t>(c)] = rgb[r];
        }
    }
    return matrix;
}

void turn_to_srgb(const Primaries& primaries, std::vector<float>& rgb,
                  std::vector<std::string>& notes) {
    if (same_colours(primaries, k_srgb_primaries)) return;
    const auto matrix = srgb_from(primaries);
    if (!matrix) {
        notes.push_back(
            "the primaries that it names span no colours: they are taken as those of sRGB");
        return;
    }
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        std::array<double, 3> turned{};
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c)
                turned[r] += (*matrix)[3 * r + c] * static_cast<double>(rgb[i + c]);
        }
        for (std::size_t c = 0; c < 3; ++c) rgb[i + c] = static_cast<float>(turned[c]);
    }
}

}  // namespace culet
