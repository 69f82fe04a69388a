#include "stone/gemcad/cut_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "stone/gemcad/cut_planes.h"
#include "stone/gemcad/gemcad_lines.h"
#include "stone/mesh/face_soup.h"
#include "stone/solid/checks.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

/// Planes must read back this well: direction in radians, distance relative to the size.
constexpr double k_reads_back = 2e-13;

double difference(const Plane& a, const Plane& b, double size) {
    return std::max(glm::length(a.normal - b.normal), std::abs(a.offset - b.offset) / size);
}

/// The shortest form with at least `places` decimals that `good` accepts, else all digits.
template <class Good>
std::string short_decimal(double value, int places, Good good) {
    for (int p = places; p <= 15; p += 2) {
        std::string text = fmt::format("{:.{}f}", value, p);
        if (good(text)) return text;
    }
    return fmt::format("{}", value);
}

double read_back(const std::string& text) {
    return number_in(text).value_or(0);
}

class LineMaker {
public:
    LineMaker(const Solid& solid, const Design& design, LineShares shares,
              std::string (*word)(const std::string&))
        : solid_(solid), design_(design), shares_(shares), word_(word), size_(diameter(solid)) {
        for (const Facet& facet : solid.facets) names_.push_back(word(facet.name));
        const bool any_named = std::any_of(names_.begin(), names_.end(),
                                           [](const std::string& name) { return !name.empty(); });
        if (any_named) names_ = unique_names(std::move(names_));
        for (std::size_t f = 0; f < names_.size(); ++f)
            facet_called_[gemcad_word(names_[f])] = int(f);
    }

    std::vector<CutLine> lines() {
        for (const DesignTier& tier : design_.tiers) add_tier(tier);
        const std::size_t first = lines_.size();
        for (std::size_t f = 0; f < names_.size(); ++f) {
            if (!placed_.contains(int(f))) add_facet(int(f), first, nullptr);
        }
        if (!labels_read_back()) {
            for (CutLine& line : lines_) {
                for (std::size_t i = 0; i < line.facets.size(); ++i) {
                    if (line.facets[i] >= 0) line.labels[i] = names_[std::size_t(line.facets[i])];
                }
            }
        }
        name_tiers_once();
        return std::move(lines_);
    }

private:
    void add_tier(const DesignTier& tier) {
        const std::size_t first = lines_.size();
        for (const DesignFacet& own : tier.facets) {
            const auto known = facet_called_.find(gemcad_word(own.facet));
            CutSetting setting = tier.setting;
            setting.index = own.index;
            const Plane plane = plane_of(setting, design_);
            if (own.facet.empty() || known == facet_called_.end()) {
                if (tier.hidden || bounds_nothing(plane))
                    add_index(line_for(plane, setting, first, &tier), own.index, own.label, -1);
            } else if (placed_.insert(known->second).second) {
                const Plane& cut = solid_.facets[std::size_t(known->second)].plane;
                if (difference(plane, cut, size_) <= k_reads_back) {
                    add_index(line_for(plane, setting, first, &tier), own.index, own.label,
                              known->second);
                } else {
                    add_facet(known->second, first, &tier, own.label);
                }
            }
        }
        if (lines_.size() > first) lines_.back().ends_tier = true;
    }

    // A plane outside the solid, which has no facet of it, may stay in the design.
    bool bounds_nothing(const Plane& plane) const {
        return std::all_of(solid_.vertices.begin(), solid_.vertices.end(), [&](const Vec3& v) {
            return height_above(plane, v) <= k_largest_miss * size_;
        });
    }

    CutLine& line_for(const Plane& plane, const CutSetting& wanted, std::size_t first,
                      const DesignTier* tier) {
        for (std::size_t i = first; i < lines_.size(); ++i) {
            if (fits(lines_[i], plane, wanted, tier != nullptr)) return lines_[i];
        }
        lines_.push_back(new_line(plane, wanted));
        lines_.back().tier = tier;
        return lines_.back();
    }

    bool fits(const CutLine& line, const Plane& plane, const CutSetting& wanted,
              bool of_tier) const {
        constexpr double k_one_angle_deg = 1e-3, k_one_distance = 2e-10;
        if (of_tier && shares_ == LineShares::tier) return true;
        CutSetting shared = line.setting;
        shared.index = wanted.index;
        if (of_tier && shares_ == LineShares::distance) {
            return shared.pavilion == wanted.pavilion &&
                   std::abs(shared.angle_deg - wanted.angle_deg) < k_one_angle_deg &&
                   std::abs(shared.distance - plane.offset) <= k_one_distance * size_;
        }
        return difference(plane_of(shared, design_), plane, size_) <= k_reads_back;
    }

    void add_index(CutLine& line, double index, const std::string& label, int facet) {
        line.indices.push_back(fmt::format("{}", index));
        line.labels.push_back(word_(label));
        line.facets.push_back(facet);
    }

    // Searches the lines from `first` on.
    void add_facet(int f, std::size_t first, const DesignTier* tier,
                   const std::string& label = {}) {
        const Plane& plane = solid_.facets[std::size_t(f)].plane;
        const CutSetting wanted = setting_of(plane, design_);
        CutLine& line = line_for(plane, wanted, first, tier);
        CutSetting setting = line.setting;
        line.indices.push_back(short_decimal(wanted.index, 0, [&](const std::string& text) {
            setting.index = read_back(text);
            return setting.index > 0 &&
                   difference(plane_of(setting, design_), plane, size_) <= 2 * k_reads_back;
        }));
        line.labels.push_back(word_(label));
        line.facets.push_back(f);
    }

    bool labels_read_back() const {
        std::vector<std::string> own, of_tier, wanted;
        for (const CutLine& line : lines_) {
            std::set<std::string> labels(line.labels.begin(), line.labels.end());
            labels.erase("");
            for (std::size_t i = 0; i < line.facets.size(); ++i) {
                if (line.facets[i] < 0) continue;
                own.push_back(line.labels[i]);
                of_tier.push_back(labels.size() == 1 ? *labels.begin() : std::string());
                wanted.push_back(names_[std::size_t(line.facets[i])]);
            }
        }
        return unique_names(std::move(own), of_tier) == wanted;
    }

    // Does as GemCad, if all names read back the same.
    void name_tiers_once() {
        std::vector<int> at;  // the one facet whose name is the tier's; -1: each has its own
        for (const CutLine& line : lines_) at.push_back(named_at(line.labels));
        const auto inherits = [&](std::size_t l, std::size_t i) {
            return at[l] >= 0 && at[l] != int(i);
        };
        for (bool again = true; again;) {
            again = false;
            std::vector<std::string> own, of_tier;
            for (std::size_t l = 0; l < lines_.size(); ++l) {
                const std::vector<std::string>& labels = lines_[l].labels;
                for (std::size_t i = 0; i < labels.size(); ++i) {
                    own.push_back(inherits(l, i) ? std::string() : labels[i]);
                    of_tier.push_back(at[l] >= 0 ? labels[std::size_t(at[l])] : std::string());
                }
            }
            const std::vector<std::string> read = unique_names(std::move(own), of_tier);
            std::size_t next = 0;
            for (std::size_t l = 0; l < lines_.size(); ++l) {
                for (const std::string& label : lines_[l].labels) {
                    if (read[next++] == label || at[l] < 0) continue;
                    at[l] = -1;
                    again = true;
                }
            }
        }
        for (std::size_t l = 0; l < lines_.size(); ++l) {
            for (std::size_t i = 0; i < lines_[l].labels.size(); ++i) {
                if (inherits(l, i)) lines_[l].labels[i].clear();
            }
        }
    }

    // The facet whose name the others repeat with .1, .2, ... in order; -1: none.
    static int named_at(const std::vector<std::string>& names) {
        if (names.size() < 2) return -1;
        const auto base = std::min_element(
            names.begin(), names.end(),
            [](const std::string& a, const std::string& b) { return a.size() < b.size(); });
        int count = 0;
        for (auto name = names.begin(); name != names.end(); ++name) {
            if (name == base) continue;
            if (base->empty() || *name != fmt::format("{}.{}", *base, ++count)) return -1;
        }
        return static_cast<int>(base - names.begin());
    }

    CutLine new_line(const Plane& plane, const CutSetting& wanted) const {
        CutLine tier;
        tier.setting = wanted;
        const auto good = [&] {
            return difference(plane_of(tier.setting, design_), plane, size_) <= k_reads_back / 2;
        };
        tier.angle = short_decimal(wanted.angle_deg, 6, [&](const std::string& text) {
            tier.setting.angle_deg = read_back(text);
            return tier.setting.angle_deg <= 90 && good();
        });
        tier.setting.angle_deg = read_back(tier.angle);
        tier.distance = short_decimal(wanted.distance, 8, [&](const std::string& text) {
            tier.setting.distance = read_back(text);
            return good();
        });
        tier.setting.distance = read_back(tier.distance);
        // GemCad writes girdle facets with the pavilion.
        if (wanted.pavilion || tier.setting.angle_deg == 90) tier.angle = "-" + tier.angle;
        return tier;
    }

    const Solid& solid_;
    const Design& design_;
    LineShares shares_;
    std::string (*word_)(const std::string&);
    double size_ = 0;
    std::vector<std::string> names_;
    std::map<std::string, int> facet_called_;
    std::set<int> placed_;
    std::vector<CutLine> lines_;
};

}  // namespace

Plane CutLine::plane(std::size_t facet, const Solid& solid, const Design& design) const {
    if (facets[facet] >= 0) return solid.facets[std::size_t(facets[facet])].plane;
    CutSetting own = tier == nullptr ? setting : tier->setting;
    own.index = read_back(indices[facet]);
    return plane_of(own, design);
}

std::vector<CutLine> cut_lines(const Solid& solid, const Design& design, LineShares shares,
                               std::string (*word)(const std::string&)) {
    return LineMaker(solid, design, shares, word).lines();
}

}  // namespace culet
