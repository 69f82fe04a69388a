// Writing GemCad .asc.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/checks.h"
#include "stone/cut_planes.h"
#include "stone/errors.h"
#include "stone/face_soup.h"
#include "stone/output_file.h"
#include "stone/text_decoding.h"

namespace culet {

namespace {

/// A plane must read back this well: the direction in radians, the distance by the size.
constexpr double k_reads_back = 2e-13;

double difference(const Plane& a, const Plane& b, double size) {
    return std::max(glm::length(a.normal - b.normal), std::abs(a.offset - b.offset) / size);
}

/// The shortest decimal form, from `places` on in steps, that still means the number to within
/// what `good` accepts; all digits if none does.
template <class Good>
std::string short_decimal(double value, int places, Good good) {
    for (int p = places; p <= 15; p += 2) {
        std::string text = fmt::format("{:.{}f}", value, p);
        if (good(text)) return text;
    }
    return fmt::format("{}", value);
}

struct Tier {
    CutSetting setting;  // as it reads back from the text
    std::string angle, distance;
    std::vector<std::string> indices, names;  // of each facet
    int named_at = -1;  // the one facet whose name is the tier's; -1: each has its own
};

double read_back(const std::string& text) {
    return number_in(text).value_or(0);
}

class AscWriter {
public:
    AscWriter(const Solid& solid, const CutSheet& sheet) : solid_(solid), sheet_(sheet) {}

    std::string text() {
        std::string out = "GemCad 5.0\n";
        const bool whole = sheet_.gear_offset == std::round(sheet_.gear_offset);
        out += fmt::format("g {} {}{}\n", sheet_.gear, sheet_.gear_offset, whole ? ".0" : "");
        out += fmt::format("y {} {}\n", sheet_.symmetry, sheet_.mirror ? "y" : "n");
        out += fmt::format("I {}\n", sheet_.refractive_index.value_or(1.54));
        for (const std::string& line : sheet_.headings) out += note('H', line);
        add_facets();
        for (const Tier& tier : tiers_) {
            std::string line = fmt::format("a {} {}", tier.angle, tier.distance);
            for (std::size_t i = 0; i < tier.indices.size(); ++i) {
                std::string setting = tier.indices[i];
                const bool named =
                    !tier.names[i].empty() && (tier.named_at < 0 || tier.named_at == int(i));
                if (named) setting += " n " + tier.names[i];
                // A line that begins with a number goes on with the tier.
                if (line.size() + setting.size() > 100) {
                    out += line + "\n";
                    line.clear();
                }
                line += (line.empty() ? "" : " ") + setting;
            }
            out += line + "\n";
        }
        for (const std::string& line : sheet_.footnotes) out += note('F', line);
        return out;
    }

private:
    static std::string note(char keyword, const std::string& line) {
        std::string text = windows1252_from_utf8(line);
        for (char& c : text) {
            if (static_cast<unsigned char>(c) < 0x20) c = ' ';
        }
        return fmt::format("{} {}\n", keyword, text);
    }

    void add_facets() {
        const double size = diameter(solid_);
        std::vector<std::string> names;
        for (const Facet& facet : solid_.facets) {
            std::string name = windows1252_from_utf8(trimmed(facet.name));
            // A name is one word.
            for (char& c : name) {
                if (static_cast<unsigned char>(c) <= 0x20 || c == 0x7f) c = '_';
            }
            names.push_back(std::move(name));
        }
        const bool any_named = std::any_of(names.begin(), names.end(),
                                           [](const std::string& name) { return !name.empty(); });
        if (any_named) names = told_apart(std::move(names));
        for (std::size_t f = 0; f < solid_.facets.size(); ++f) {
            const Plane& plane = solid_.facets[f].plane;
            const CutSetting wanted = setting_of(plane, sheet_);
            Tier* tier = nullptr;
            for (Tier& known : tiers_) {
                CutSetting shared = known.setting;
                shared.index = wanted.index;
                if (difference(plane_of(shared, sheet_), plane, size) <= k_reads_back) {
                    tier = &known;
                    break;
                }
            }
            if (tier == nullptr) tier = &tiers_.emplace_back(new_tier(plane, wanted, size));
            CutSetting setting = tier->setting;
            std::string word = short_decimal(wanted.index, 0, [&](const std::string& text) {
                setting.index = read_back(text);
                return setting.index > 0 &&
                       difference(plane_of(setting, sheet_), plane, size) <= 2 * k_reads_back;
            });
            tier->indices.push_back(std::move(word));
            tier->names.push_back(names[f]);
        }
        name_tiers_once();
    }

    // A tier A, A.1, A.2, ... is named once, as GemCad does, wherever all names read back so.
    void name_tiers_once() {
        for (Tier& tier : tiers_) tier.named_at = named_at(tier.names);
        for (bool again = true; again;) {
            again = false;
            std::vector<std::string> own, of_tier;
            for (const Tier& tier : tiers_) {
                const bool once = tier.named_at >= 0;
                for (std::size_t i = 0; i < tier.names.size(); ++i) {
                    const bool inherits = once && tier.named_at != int(i);
                    own.push_back(inherits ? std::string() : tier.names[i]);
                    of_tier.push_back(once ? tier.names[std::size_t(tier.named_at)]
                                           : std::string());
                }
            }
            const std::vector<std::string> read = told_apart(std::move(own), of_tier);
            std::size_t at = 0;
            for (Tier& tier : tiers_) {
                for (const std::string& name : tier.names) {
                    if (read[at++] == name || tier.named_at < 0) continue;
                    tier.named_at = -1;
                    again = true;
                }
            }
        }
    }

    // Which facet has the name that the others repeat: .1, .2, ... in their order; -1: none.
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

    Tier new_tier(const Plane& plane, const CutSetting& wanted, double size) const {
        Tier tier;
        tier.setting = wanted;
        const auto good = [&] {
            return difference(plane_of(tier.setting, sheet_), plane, size) <= k_reads_back / 2;
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
        // Girdle facets stand with the pavilion, as GemCad writes them.
        if (wanted.pavilion || tier.setting.angle_deg == 90) tier.angle = "-" + tier.angle;
        return tier;
    }

    const Solid& solid_;
    const CutSheet& sheet_;
    std::vector<Tier> tiers_;
};

bool origin_is_inside(const Solid& solid) {
    const double margin = 1e-6 * diameter(solid);
    return std::all_of(solid.facets.begin(), solid.facets.end(),
                       [&](const Facet& facet) { return facet.plane.offset > margin; });
}

}  // namespace

std::vector<std::string> write_gemcad_asc(const Solid& solid, const CutSheet& sheet,
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
    if (!(std::abs(sheet.gear) >= 1)) {
        throw InputError(file, "cannot be written: the index gear needs at least one tooth");
    }
    std::vector<std::string> notes;
    if (origin_is_inside(solid)) {
        write_text(file, AscWriter(solid, sheet).text());
        return notes;
    }
    const Vec3 middle = centroid(solid);
    Solid moved = solid;
    for (Vec3& v : moved.vertices) v -= middle;
    for (Facet& facet : moved.facets) {
        facet.plane.offset -= glm::dot(facet.plane.normal, middle);
    }
    notes.push_back(
        fmt::format("moved by ({}, {}, {}): GemCad measures from a point inside the "
                    "stone",
                    -middle.x, -middle.y, -middle.z));
    CutSheet moved_sheet = sheet;
    moved_sheet.footnotes.push_back(notes.back());
    write_text(file, AscWriter(moved, moved_sheet).text());
    return notes;
}

}  // namespace culet
