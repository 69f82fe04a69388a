// Writes GemCad .asc.

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
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace {

/// Planes must read back this well: direction in radians, distance relative to the size.
constexpr double k_reads_back = 2e-13;
/// Quartz, GemCad's default.
constexpr double k_gemcads_index = 1.54;

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

// Facets of one angle and distance.
struct Line {
    CutSetting setting;  // as it reads back from the text
    std::string angle, distance;
    std::vector<std::string> indices, labels;
    std::vector<int> facets;  // of the solid; -1: only in the design
    std::string instruction;
    int named_at = -1;  // the one facet whose name is the tier's; -1: each has its own
};

double read_back(const std::string& text) {
    return number_in(text).value_or(0);
}

class AscWriter {
public:
    AscWriter(const Solid& solid, const Design& design)
        : solid_(solid), design_(design), size_(diameter(solid)) {
        for (const Facet& facet : solid.facets) names_.push_back(gemcad_word(facet.name));
        const bool any_named = std::any_of(names_.begin(), names_.end(),
                                           [](const std::string& name) { return !name.empty(); });
        if (any_named) names_ = unique_names(std::move(names_));
        for (std::size_t f = 0; f < names_.size(); ++f) facet_called_[names_[f]] = int(f);
    }

    std::string text() {
        for (const DesignTier& tier : design_.tiers) add_tier(tier);
        const std::size_t first = lines_.size();
        for (std::size_t f = 0; f < names_.size(); ++f) {
            if (!placed_.contains(int(f))) add_facet(int(f), first);
        }
        if (!labels_read_back()) {
            for (Line& line : lines_) {
                for (std::size_t i = 0; i < line.facets.size(); ++i) {
                    if (line.facets[i] >= 0) line.labels[i] = names_[std::size_t(line.facets[i])];
                }
            }
        }
        name_tiers_once();
        std::string out = gemcad_head(design_, design_.refractive_index.value_or(k_gemcads_index));
        for (const Line& line : lines_) out += text_of(line);
        return out + gemcad_feet(design_);
    }

private:
    static std::string text_of(const Line& tier) {
        std::string out, line = fmt::format("a {} {}", tier.angle, tier.distance);
        const auto add = [&](const std::string& word) {
            // A line that begins with a number continues the tier.
            if (line.size() + word.size() > 100) {
                out += line + "\n";
                line.clear();
            }
            line += (line.empty() ? "" : " ") + word;
        };
        for (std::size_t i = 0; i < tier.indices.size(); ++i) {
            const bool named =
                !tier.labels[i].empty() && (tier.named_at < 0 || tier.named_at == int(i));
            add(tier.indices[i] + (named ? " n " + tier.labels[i] : std::string()));
        }
        if (!tier.instruction.empty()) {
            std::string words = gemcad_line('G', tier.instruction);
            words.pop_back();
            line += " " + words;
        }
        return out + line + "\n";
    }

    void add_tier(const DesignTier& tier) {
        const std::size_t first = lines_.size();
        for (const DesignFacet& own : tier.facets) {
            const auto known = facet_called_.find(gemcad_word(own.facet));
            CutSetting setting = tier.setting;
            setting.index = own.index;
            const Plane plane = plane_of(setting, design_);
            if (own.facet.empty() || known == facet_called_.end()) {
                if (bounds_nothing(plane))
                    add_index(line_for(plane, setting, first), own.index, own.label, -1);
            } else if (placed_.insert(known->second).second) {
                const Plane& cut = solid_.facets[std::size_t(known->second)].plane;
                if (difference(plane, cut, size_) <= k_reads_back) {
                    add_index(line_for(plane, setting, first), own.index, own.label, known->second);
                } else {
                    add_facet(known->second, first, own.label);
                }
            }
        }
        if (lines_.size() > first) lines_.back().instruction = tier.instruction;
    }

    // A plane outside the solid, which has no facet of it, may stay in the design.
    bool bounds_nothing(const Plane& plane) const {
        return std::all_of(solid_.vertices.begin(), solid_.vertices.end(), [&](const Vec3& v) {
            return height_above(plane, v) <= k_largest_miss * size_;
        });
    }

    Line& line_for(const Plane& plane, const CutSetting& wanted, std::size_t first) {
        for (std::size_t i = first; i < lines_.size(); ++i) {
            CutSetting shared = lines_[i].setting;
            shared.index = wanted.index;
            if (difference(plane_of(shared, design_), plane, size_) <= k_reads_back)
                return lines_[i];
        }
        return lines_.emplace_back(new_line(plane, wanted));
    }

    static void add_index(Line& line, double index, const std::string& label, int facet) {
        line.indices.push_back(fmt::format("{}", index));
        line.labels.push_back(gemcad_word(label));
        line.facets.push_back(facet);
    }

    // Searches the lines from `first` on.
    void add_facet(int f, std::size_t first, const std::string& label = {}) {
        const Plane& plane = solid_.facets[std::size_t(f)].plane;
        const CutSetting wanted = setting_of(plane, design_);
        Line& line = line_for(plane, wanted, first);
        CutSetting setting = line.setting;
        line.indices.push_back(short_decimal(wanted.index, 0, [&](const std::string& text) {
            setting.index = read_back(text);
            return setting.index > 0 &&
                   difference(plane_of(setting, design_), plane, size_) <= 2 * k_reads_back;
        }));
        line.labels.push_back(gemcad_word(label));
        line.facets.push_back(f);
    }

    bool labels_read_back() const {
        std::vector<std::string> own, of_tier, wanted;
        for (const Line& line : lines_) {
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
        for (Line& tier : lines_) tier.named_at = named_at(tier.labels);
        for (bool again = true; again;) {
            again = false;
            std::vector<std::string> own, of_tier;
            for (const Line& tier : lines_) {
                const bool once = tier.named_at >= 0;
                for (std::size_t i = 0; i < tier.labels.size(); ++i) {
                    const bool inherits = once && tier.named_at != int(i);
                    own.push_back(inherits ? std::string() : tier.labels[i]);
                    of_tier.push_back(once ? tier.labels[std::size_t(tier.named_at)]
                                           : std::string());
                }
            }
            const std::vector<std::string> read = unique_names(std::move(own), of_tier);
            std::size_t at = 0;
            for (Line& tier : lines_) {
                for (const std::string& label : tier.labels) {
                    if (read[at++] == label || tier.named_at < 0) continue;
                    tier.named_at = -1;
                    again = true;
                }
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

    Line new_line(const Plane& plane, const CutSetting& wanted) const {
        Line tier;
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
    double size_ = 0;
    std::vector<std::string> names_;
    std::map<std::string, int> facet_called_;
    std::set<int> placed_;
    std::vector<Line> lines_;
};

bool origin_is_inside(const Solid& solid) {
    const double margin = 1e-6 * diameter(solid);
    return std::all_of(solid.facets.begin(), solid.facets.end(),
                       [&](const Facet& facet) { return facet.plane.offset > margin; });
}

}  // namespace

std::vector<std::string> write_gemcad_asc(const Solid& solid, const Design& design,
                                          const std::filesystem::path& file) {
    if (!is_closed(solid)) {
        throw InputError(file,
                         "cannot be written: a cut design holds a closed stone only, and this "
                         "one is open or broken (see culet info)");
    }
    if (!is_convex(solid)) {
        throw InputError(file,
                         "cannot be written: a cut design holds a convex stone only, and this "
                         "one is not convex or inside out (see culet info)");
    }
    if (!(std::abs(design.gear) >= 1)) {
        throw InputError(file, "cannot be written: the index gear needs at least one tooth");
    }
    std::vector<std::string> notes;
    if (origin_is_inside(solid)) {
        write_text(file, AscWriter(solid, design).text());
        return notes;
    }
    const Vec3 middle = centroid(solid);
    Solid moved = solid;
    for (Vec3& v : moved.vertices) v -= middle;
    for (Facet& facet : moved.facets) {
        facet.plane.offset -= glm::dot(facet.plane.normal, middle);
    }
    notes.push_back(
        fmt::format("moved by ({}, {}, {}), because GemCad measures from a point inside the stone",
                    -middle.x, -middle.y, -middle.z));
    Design moved_design = design;
    moved_design.footnotes.push_back(notes.back());
    write_text(file, AscWriter(moved, moved_design).text());
    return notes;
}

}  // namespace culet
