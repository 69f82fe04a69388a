// A cut's proportions, from the corners that count for them.

#include <cmath>
#include <numbers>

#include "stone/design/cut_choice.h"
#include "stone/solid/angles.h"

namespace culet {

namespace {

double mean_height(const CutCorners& corners, const CutPlaces& at) {
    double mean = 0;
    for (const int c : corners) mean += at[std::size_t(c)].z / double(corners.size());
    return mean;
}

double mean_radius(const CutCorners& loop, const CutPlaces& at) {
    Vec3 middle(0);
    for (const int c : loop) middle += at[std::size_t(c)] / double(loop.size());
    double mean = 0;
    for (const int c : loop)
        mean += glm::length(in_plan(at[std::size_t(c)] - middle)) / double(loop.size());
    return mean;
}

}  // namespace

class CutMeasures::Values {
public:
    Values(const Cut& cut, const CutPlaces& at) : cut_(cut), at_(at), along_(cut.along(at)) {
        for (std::size_t i = 0; i < cut.hull.size(); ++i)
            diameter_ +=
                apart({cut.hull[i], cut.hull[(i + 1) % cut.hull.size()]}) / std::numbers::pi;
        width_ = glm::dot(along_.across, between(at, {cut.jaw[0], cut.opposite}));
        size_ = cut.is_round ? diameter_ : width_;
        all.reserve(40);
    }

    void put_sizes() {
        const double length = glm::dot(along_.edge, between(at_, cut_.ends));
        if (cut_.is_round) put("diameter", diameter_);
        put("width", width_);
        put("length", length);
        put("caliper min", width_);
        put("caliper max", apart(cut_.widest));
        put("caliper mean", diameter_);
        all.push_back({"length/width", "", length / width_});
    }
    void put_heights() {
        const double top = mean_height(cut_.top, at_), bottom = mean_height(cut_.bottom, at_);
        put("depth", top - bottom);
        per_cent("total depth", top - bottom);
        put_flat("table", cut_.table, cut_.table_ends);
        if (!cut_.upper.empty() && !cut_.lower.empty()) {
            const double high = mean_height(cut_.upper, at_), low = mean_height(cut_.lower, at_);
            per_cent("crown height", top - high);
            per_cent("girdle thickness", high - low);
            per_cent("pavilion depth", low - bottom);
        }
        if (!cut_.girdle_at_mains.empty() && !cut_.pavilion_at_mains.empty()) {
            per_cent("crown height at mains", top - mean_height(cut_.crown_at_mains, at_));
            double girdle = 0;
            for (const Chord& chord : cut_.girdle_at_mains) girdle += chord.length(at_);
            per_cent("girdle at mains", girdle / double(cut_.girdle_at_mains.size()));
            per_cent("pavilion depth at mains", mean_height(cut_.pavilion_at_mains, at_) - bottom);
        }
        put_flat("culet", cut_.culet, cut_.culet_ends);
        if (!cut_.table_extremes.empty()) {
            per_cent("table min", apart(cut_.table_extremes[1]));
            per_cent("table max", apart(cut_.table_extremes[0]));
        }
        if (cut_.girdle_extremes.empty()) return;
        per_cent("girdle min", cut_.girdle_extremes[1].length(at_));
        per_cent("girdle max", cut_.girdle_extremes[0].length(at_));
        per_cent("girdle mean", mean_thickness(cut_.flats, at_));
    }
    void put_tips() {
        const auto part = [](const Vec3& from, const Vec3& tip, const Vec3& end) {
            const Vec3 way = in_plan(end - from);
            return glm::dot(in_plan(tip - from), way) / glm::dot(way, way);
        };
        double stars = 0, halves = 0;
        for (const StarTip& star : cut_.stars)
            stars += part(0.5 * (place(star.edge[0]) + place(star.edge[1])), place(star.tip),
                          place(star.girdle));
        const Vec3 culet = middle_of(cut_.low(), at_);
        for (const HalfTip& half : cut_.halves)
            halves += part(place(half.girdle), place(half.tip), culet);
        if (!cut_.stars.empty())
            all.push_back({"star length", "%", 100 * stars / double(cut_.stars.size())});
        if (!cut_.halves.empty())
            all.push_back({"lower half length", "%", 100 * halves / double(cut_.halves.size())});
    }
    void put_symmetry() {
        if (!cut_.is_round) return;
        per_cent("out of round", apart(cut_.widest) - width_);
        const Vec3 outline = middle_of(cut_.hull, at_), culet = middle_of(cut_.low(), at_);
        per_cent("culet off-centre", glm::dot(cut_.culet_off, culet - outline));
        if (!cut_.table.empty()) {
            const Vec3 table = middle_of(cut_.table, at_);
            per_cent("table off-centre", glm::dot(cut_.table_off, table - outline));
            per_cent("table/culet", glm::dot(cut_.table_to_culet, culet - table));
        }
        const auto heights = [&](const char* name, const CutCorners& ends) {
            if (!ends.empty()) per_cent(name, place(ends[0]).z - place(ends[1]).z);
        };
        heights("crown height variation", cut_.crown_extremes);
        heights("pavilion depth variation", cut_.pavilion_extremes);
        if (!cut_.girdle_variation.empty())
            per_cent("girdle variation",
                     cut_.girdle_variation[0].length(at_) - cut_.girdle_variation[1].length(at_));
        if (!cut_.table_extremes.empty())
            per_cent("table variation",
                     apart(cut_.table_extremes[0]) - apart(cut_.table_extremes[1]));
    }
    std::vector<CutMeasure> all;

private:
    const Vec3& place(int corner) const { return at_[std::size_t(corner)]; }
    double apart(const CutPair& ends) const { return glm::length(in_plan(between(at_, ends))); }
    void put(const char* name, double value) { all.push_back({name, "length", value}); }
    void per_cent(const char* name, double value) {
        all.push_back({name, "%", 100 * value / size_});
    }
    void put_flat(const char* name, const CutCorners& loop, const CutPair& ends) {
        if (loop.empty()) return;
        per_cent(name, cut_.is_round ? 2 * mean_radius(loop, at_)
                                     : glm::dot(along_.across, between(at_, ends)));
    }

    const Cut& cut_;
    const CutPlaces& at_;
    Cut::Along along_;
    double diameter_ = 0, width_ = 0, size_ = 1;
};

std::vector<CutMeasure> CutMeasures::lengths(const std::vector<Vec3>& at) const {
    if (cut_->hull.empty()) return {};
    Values values(*cut_, at);
    values.put_sizes();
    values.put_heights();
    values.put_tips();
    values.put_symmetry();
    return std::move(values.all);
}

std::vector<CutMeasure> cut_measures(const Solid& solid) {
    const CutMeasures measures(solid, cut_roles(solid));
    std::vector<CutMeasure> all = measures.lengths(solid.vertices);
    for (const CutMeasures::Angle& angle : measures.angles()) {
        CutMeasure sum{angle.name, "deg", 0};
        for (const auto& [f, factor] : angle.of)
            sum.value += factor * inclination(solid.facets[std::size_t(f)].plane.normal, {0, 0, 1});
        all.push_back(std::move(sum));
    }
    return all;
}

double rounding_step(ReportStyle style, const std::string& name, const std::string& unit) {
    if (style == ReportStyle::plain || (unit != "%" && unit != "deg")) return 0;
    // Laboratories take heights where mains meet the girdle.
    for (const char* mean : {"crown height", "girdle thickness", "pavilion depth"})
        if (name == mean) return 0;
    if (style == ReportStyle::ags) return 0.1;
    if (name == "table") return 1;
    if (name == "crown angle") return 0.5;
    if (name == "pavilion angle") return 0.2;
    if (name == "star length" || name == "lower half length") return 5;
    if (name == "total depth") return 0.1;
    return name.ends_with(" at mains") ? 0.5 : 0;
}

double rounded_to(double value, double step) {
    // In tenths, so that 34.5 is written as such.
    return step > 0 ? std::round(std::round(value / step) * (10 * step)) / 10 : value;
}

}  // namespace culet
