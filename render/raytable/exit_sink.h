#pragma once
// Collects exit events of light paths for a ray table.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "render/optics/path.h"
#include "render/raytable/octahedral_codes.h"
#include "stone/solid/perpendicular.h"

namespace culet {

/// The end of a light path outside the stone. Lengths in the stone's unit.
struct ExitEvent {
    float weight = 0;  ///< without absorption
    int facet = 0;
    DirectionCode direction{};
    float s = 0, t = 0;             ///< coordinates of the point along the facet's axes
    std::array<float, 3> length{};  ///< inside the stone, per axis of a crystal
};

/// In-plane axes of a facet, orthonormal.
struct PlaneAxes {
    Vec3 u, v;
    explicit PlaneAxes(const Vec3& normal)
        : u(perpendicular_to(normal)), v(glm::cross(normal, u)) {}
};

/// Exit events of a row of pixels in one band.
struct RowExits {
    std::vector<ExitEvent> exits;
    std::vector<std::uint32_t> count;  ///< per hit of the row
    double remainder = 0, cut = 0;     ///< sums over hits
    int deepest = 0;
};

/// A band for measuring path lengths: one wavelength per length, which absorbs along one axis only,
/// by `absorption` per unit of length. The first wavelength absorbs nothing: it has the weight of a
/// clear stone.
inline Band with_lengths(Band band, int lengths, double absorption) {
    band.absorbs = true;
    band.first = 0;
    band.count = 1 + lengths;
    for (int axis = 0; axis < 3; ++axis) {
        band.absorption[axis].fill(0);
        if (lengths == 1) {
            band.absorption[axis][1] = absorption;
        } else {
            band.absorption[axis][1 + axis] = absorption;
        }
    }
    return band;
}

// A sink of the tracers (light_paths.h, crystal_paths.h).
class ExitSink {
public:
    ExitSink(const std::vector<PlaneAxes>& axes, int lengths, double absorption, double least,
             RowExits& row)
        : axes_(axes), lengths_(lengths), absorption_(absorption), least_(least), row_(row) {}

    void path_exits(const Vec3& at, const Vec3& direction, const NodeWeights& weight,
                    const PathTrace& trace) {
        keep(at, direction, weight[0], weight, trace);
    }
    void path_exits(const PathEnd& end, const PathTrace& trace) {
        keep(end.at, end.direction, end.coherency.power(), end.transmitted, trace);
    }
    void remainder(const NodeWeights& weight) { row_.remainder += weight[0]; }
    void cut(const NodeWeights& weight) { row_.cut += weight[0]; }
    void absorbed(const NodeWeights&) {}
    void roulette(const NodeWeights&) {}
    void choice_begins() {}
    void choice_ends(bool) {}

private:
    // `transmitted`: its wavelengths' ratios give the lengths.
    void keep(const Vec3& at, const Vec3& direction, double weight, const NodeWeights& transmitted,
              const PathTrace& trace) {
        row_.deepest = std::max(row_.deepest, trace.length);
        if (weight < least_) {
            row_.cut += weight;
            return;
        }
        ExitEvent exit_event;
        exit_event.weight = static_cast<float>(weight);
        exit_event.facet = trace.facets[trace.length - 1];
        exit_event.direction = octahedral_code(direction);
        const PlaneAxes& axes = axes_[static_cast<std::size_t>(exit_event.facet)];
        exit_event.s = static_cast<float>(glm::dot(axes.u, at));
        exit_event.t = static_cast<float>(glm::dot(axes.v, at));
        for (int k = 0; k < lengths_; ++k) {
            const double ratio = transmitted[1 + k] / transmitted[0];
            exit_event.length[k] =
                static_cast<float>(std::max(0.0, -std::log(ratio) / absorption_));
        }
        row_.exits.push_back(exit_event);
        ++row_.count.back();
    }

    const std::vector<PlaneAxes>& axes_;
    int lengths_;
    double absorption_, least_;
    RowExits& row_;
};

}  // namespace culet
