#include "render/optics/eye_optics.h"

#include <cmath>
#include <numbers>

namespace culet {

Stokes response(const EyeOptics& optics, double wavelength_nm, int window) {
    if (!optics.analyzer) return {1, 0, 0, 0};
    // Radiance behind the analyser: (S0 + S1 cos 2a + S2 sin 2a) / 2.
    const double angle = 2 * (*optics.analyzer + window * std::numbers::pi / 2);
    Stokes row{0.5, 0.5 * std::cos(angle), 0.5 * std::sin(angle), 0};
    if (!optics.retarder) return row;
    // The plate acts first: in its frame S2 + i S3 turns by the phase that the slow wave loses,
    // like the coherency x conj(y) when x is slow.
    const double axis = 2 * optics.retarder->slow_axis;
    const double phase = 2 * std::numbers::pi * optics.retarder->retardation_nm / wavelength_nm;
    const double c = std::cos(axis), s = std::sin(axis);
    // Transform the row to the plate's frame, through the plate, and back.
    const double along = row[1] * c + row[2] * s, across = -row[1] * s + row[2] * c;
    const double turned = across * std::cos(phase), circular = -across * std::sin(phase);
    return {row[0], along * c - turned * s, along * s + turned * c, circular};
}

std::vector<Stokes> responses(const EyeOptics& optics, const std::vector<double>& wavelengths_nm) {
    std::vector<Stokes> rows;
    for (const double nm : wavelengths_nm) rows.push_back(response(optics, nm));
    return rows;
}

void look_through(const std::vector<Stokes>& responses, int planes, double* stokes) {
    if (planes == 1) return;
    const std::size_t nodes = responses.size();
    for (std::size_t node = 0; node < nodes; ++node) {
        double seen = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(planes); ++k)
            seen += responses[node][k] * stokes[k * nodes + node];
        stokes[node] = seen;
    }
}

}  // namespace culet
