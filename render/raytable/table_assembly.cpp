#include "render/raytable/table_assembly.h"

#include <limits>
#include <utility>

namespace culet {

namespace {

// Bounding rectangle of a facet's exit events in its plane.
struct Box {
    static constexpr float k_none = std::numeric_limits<float>::infinity();
    float s0 = k_none, t0 = k_none, s1 = -k_none, t1 = -k_none;

    void hold(const ExitEvent& exit_event) {
        s0 = std::min(s0, exit_event.s);
        t0 = std::min(t0, exit_event.t);
        s1 = std::max(s1, exit_event.s);
        t1 = std::max(t1, exit_event.t);
    }
    bool empty() const { return !(s0 <= s1); }
};

// Quantises to 65535 steps from `low` to `high`.
std::uint16_t step(float value, double low, double high) {
    const double part = high > low ? (static_cast<double>(value) - low) / (high - low) : 0;
    return static_cast<std::uint16_t>(std::lround(part * 65535));
}

class Assembly {
public:
    Assembly(TableContent content, const StoneBody& body, const std::vector<PlaneAxes>& axes)
        : content_(std::move(content)), body_(body), axes_(axes), boxes_(axes.size()) {}

    RayTable make() {
        measure();
        for (std::size_t f = 0; f < axes_.size(); ++f) parts_.frames.push_back(frame_of(f));
        for (std::vector<RowExits>& rows : content_.bands) {
            auto end = static_cast<std::uint32_t>(parts_.weight.size());
            for (RowExits& row : rows) {
                for (const std::uint32_t count : row.count)
                    parts_.exits_end.push_back(end += count);
                for (const ExitEvent& exit_event : row.exits) put(exit_event);
                row = {};  // frees its memory
            }
        }
        parts_.wavelengths_nm = std::move(content_.wavelengths_nm);
        parts_.hit_ray = std::move(content_.hit_ray);
        parts_.hit_distance = std::move(content_.hit_distance);
        return RayTable(content_.header, parts_);
    }

private:
    void measure() {
        RayTableHeader& header = content_.header;
        double remainder = 0, cut = 0;
        for (const std::vector<RowExits>& rows : content_.bands) {
            for (const RowExits& row : rows) {
                remainder += row.remainder;
                cut += row.cut;
                header.deepest = std::max(header.deepest, static_cast<std::uint32_t>(row.deepest));
                for (const ExitEvent& exit_event : row.exits) {
                    boxes_[static_cast<std::size_t>(exit_event.facet)].hold(exit_event);
                    for (const float length : exit_event.length)
                        longest_ = std::max(longest_, length);
                }
            }
        }
        const double paths = std::max(1.0, static_cast<double>(content_.hit_ray.size()) *
                                               static_cast<double>(content_.bands.size()));
        header.remainder = remainder / paths;
        header.cut = cut / paths;
        header.length_step = static_cast<double>(longest_) / 65535;
    }

    FacetFrame frame_of(std::size_t facet) {
        Box& box = boxes_[facet];
        if (box.empty()) box = {0, 0, 0, 0};
        const Vec3& along = axes_[facet].u;
        const Vec3& across = axes_[facet].v;
        const double s0 = static_cast<double>(box.s0), s1 = static_cast<double>(box.s1),
                     t0 = static_cast<double>(box.t0), t1 = static_cast<double>(box.t1);
        const Vec3 corner = body_.on_facet(static_cast<int>(facet), s0 * along + t0 * across);
        const Vec3 u = (s1 - s0) * along, v = (t1 - t0) * across;
        return {{corner.x, corner.y, corner.z}, {u.x, u.y, u.z}, {v.x, v.y, v.z}};
    }

    void put(const ExitEvent& exit_event) {
        const Box& box = boxes_[static_cast<std::size_t>(exit_event.facet)];
        parts_.weight.push_back(exit_event.weight);
        parts_.facet.push_back(static_cast<std::uint16_t>(exit_event.facet));
        for (std::size_t k = 0; k < 2; ++k) parts_.direction[k].push_back(exit_event.direction[k]);
        parts_.point[0].push_back(
            step(exit_event.s, static_cast<double>(box.s0), static_cast<double>(box.s1)));
        parts_.point[1].push_back(
            step(exit_event.t, static_cast<double>(box.t0), static_cast<double>(box.t1)));
        for (std::size_t k = 0; k < content_.header.lengths; ++k)
            parts_.length[k].push_back(
                step(exit_event.length[k], 0, static_cast<double>(longest_)));
    }

    TableContent content_;
    const StoneBody& body_;
    const std::vector<PlaneAxes>& axes_;
    std::vector<Box> boxes_;
    float longest_ = 0;
    RayTableParts<TableVector> parts_;
};

}  // namespace

std::vector<PlaneAxes> plane_axes(const StoneBody& body, std::size_t facets) {
    std::vector<PlaneAxes> axes;
    for (std::size_t f = 0; f < facets; ++f) axes.emplace_back(body.normal(static_cast<int>(f)));
    return axes;
}

RayTable assembled(TableContent content, const StoneBody& body,
                   const std::vector<PlaneAxes>& axes) {
    return Assembly(std::move(content), body, axes).make();
}

}  // namespace culet
