#include "fit/readings/readings_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "stone/design/index_names.h"
#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/solid/caliper.h"

namespace culet {

namespace {

// Root of a facet's area: above the first it seats well in a goniometer, above the second barely.
constexpr double k_large_mm = 1, k_small_mm = 0.6;
// Two mains within this of opposite directions stand across one width.
constexpr double k_across_deg = 3;
// Measure along x and y if the smaller width there is at most this times the least width.
constexpr double k_along_axes = 1.03;

std::string quoted(const std::string& field) {
    const bool plain = field.find_first_of(",;\t\"\r\n") == std::string::npos;
    if (plain && !field.starts_with('#')) return field;
    std::string text = "\"";
    for (const char c : field) text += c == '"' ? "\"\"" : std::string(1, c);
    return text + "\"";
}

// True if `of` takes the name literally.
bool can_be_read(const std::string& name) {
    return !name.empty() && name.find_first_of("/,*()\r\n") == std::string::npos &&
           name.front() != ' ' && name.back() != ' ';
}

class FormWriter {
public:
    FormWriter(const Stone& stone, bool has_material, double gear, const BenchSigmas& sigmas)
        : stone_(stone),
          solid_(stone.solid),
          has_material_(has_material),
          sigmas_(sigmas),
          frame_(plan_frame(stone.up)),
          table_(table_facet(stone.solid, stone.up)),
          names_(index_names(stone.solid, gear)),
          teeth_(index_teeth(stone.solid, gear)),
          gear_(gear) {}

    ReadingsForm form() {
        const std::vector<FacetTier> tiers = tiers_of(solid_, stone_.up);
        const std::vector<int> crown = whole_tiers(main_facets(solid_, stone_.up, true), tiers),
                               pavilion = whole_tiers(main_facets(solid_, stone_.up, false), tiers);
        add_mains(crown);
        add_mains(pavilion);
        std::vector<int> mains = crown;
        mains.insert(mains.end(), pavilion.begin(), pavilion.end());
        for (const FacetTier& tier : tiers) add_tier(tier, mains);
        add_lengths(crown);
        ReadingsForm form;
        form.csv = instructions() + "kind,of,value,sigma,note\n";
        for (const FormRow& r : rows_) {
            form.csv +=
                fmt::format("{},{},,{:.4g},{}\n", r.kind, quoted(r.of), r.sigma, quoted(r.note));
        }
        form.rows = std::move(rows_);
        if (table_ >= 0) form.up_facet = solid_.facets[table_].name;
        return form;
    }

private:
    double millimetres(double length) const { return length * mm_per(stone_.unit); }

    void row(const std::string& kind, const std::string& of, double sigma,
             const std::string& note) {
        rows_.push_back({kind, of, sigma, note});
    }

    double tilt_deg(int facet) const {
        return degrees(inclination(solid_.facets[facet].plane.normal, stone_.up));
    }
    double azimuth_deg(int facet) const {
        const Vec3& n = solid_.facets[facet].plane.normal;
        return degrees(std::atan2(glm::dot(n, frame_.y), glm::dot(n, frame_.x)));
    }

    double sigma_of(int facet) const {
        const double size = millimetres(std::sqrt(area(solid_, solid_.facets[facet])));
        if (size >= k_large_mm) return sigmas_.large_facet_deg;
        return size >= k_small_mm ? sigmas_.small_facet_deg : sigmas_.tiny_facet_deg;
    }

    void add_facet(int facet) {
        const std::string &name = names_[std::size_t(facet)], &tooth = teeth_[std::size_t(facet)];
        if (!can_be_read(name)) return;
        row("inclination", name, sigma_of(facet),
            fmt::format("expected {:.2f}{}{}", tilt_deg(facet), tooth.empty() ? "" : " at index ",
                        tooth));
    }

    // Completes the tiers of the mains: in a pear only some facets of a tier may reach the table.
    static std::vector<int> whole_tiers(const std::vector<int>& mains,
                                        const std::vector<FacetTier>& tiers) {
        std::vector<int> all;
        for (const FacetTier& tier : tiers) {
            const bool any = std::any_of(tier.facets.begin(), tier.facets.end(), [&](int f) {
                return std::find(mains.begin(), mains.end(), f) != mains.end();
            });
            if (any) all.insert(all.end(), tier.facets.begin(), tier.facets.end());
        }
        std::sort(all.begin(), all.end());
        return all;
    }

    void add_mains(const std::vector<int>& mains) {
        for (const int f : mains) add_facet(f);
    }

    void add_tier(const FacetTier& tier, const std::vector<int>& mains) {
        if (tier.part == StonePart::table) return;
        std::vector<int> facets;
        for (const int f : tier.facets) {
            const bool main = std::find(mains.begin(), mains.end(), f) != mains.end();
            if (!main && can_be_read(names_[std::size_t(f)])) facets.push_back(f);
        }
        if (facets.empty()) return;
        if (facets.size() == 1) return add_facet(facets[0]);
        // One value for several facets is also off by their differences.
        double sigma = sigmas_.small_facet_deg, least = 90, most = 0;
        std::string names;
        for (const int f : facets) {
            sigma = std::max(sigma, sigma_of(f));
            least = std::min(least, tilt_deg(f));
            most = std::max(most, tilt_deg(f));
            names += (names.empty() ? "" : "/") + names_[std::size_t(f)];
        }
        const std::string expected = most - least < 0.05
                                         ? fmt::format("expected {:.2f}", degrees(tier.inclination))
                                         : fmt::format("expected {:.2f} to {:.2f}", least, most);
        const bool has_pattern = facets.size() == tier.facets.size() && !tier.pattern.empty();
        row("inclination", has_pattern ? tier.pattern : "each(" + names + ")",
            std::max(sigma, sigmas_.tier_deg),
            fmt::format("{} (one value for all {})", expected, facets.size()));
    }

    // The largest of these crown facets in this direction; empty if there is none.
    std::string facet_towards(double azimuth, const std::vector<int>& crown) const {
        std::string name;
        double largest = 0;
        for (const int f : crown) {
            const double size = area(solid_, solid_.facets[f]);
            if (std::abs(std::remainder(azimuth_deg(f) - azimuth, 360)) < k_across_deg &&
                size > largest) {
                name = names_[std::size_t(f)];
                largest = size;
            }
        }
        return name;
    }

    // Four directions from jaw to jaw, degrees in [0, 180): across opposite mains of a round stone,
    // else along and between width and length.
    std::vector<double> directions(const CaliperWidths& widths,
                                   const std::vector<int>& crown) const {
        const auto half_turn = [](double a) {
            a = std::fmod(std::fmod(a, 180) + 180, 180);
            return 180 - a < 0.5 ? 0 : a;
        };
        double first = half_turn(degrees(widths.least_azimuth) - 90);
        if (widths.round() && !crown.empty()) {
            first = 180;
            for (const int f : crown) first = std::min(first, half_turn(azimuth_deg(f)));
        } else if (std::min(width_along(solid_, frame_.x), width_along(solid_, frame_.y)) <
                   k_along_axes * widths.least) {
            first = 0;
        }
        std::vector<double> all;
        for (int i = 0; i < 4; ++i) {
            all.push_back(std::round(100 * half_turn(first + 45 * i)) / 100);
        }
        std::sort(all.begin(), all.end());
        return all;
    }

    double extent(const std::vector<int>& corners, double azimuth) const {
        const Vec3 along =
            std::cos(radians(azimuth)) * frame_.x + std::sin(radians(azimuth)) * frame_.y;
        double low = 1e300, high = -1e300;
        for (const int c : corners) {
            low = std::min(low, glm::dot(along, solid_.vertices[c]));
            high = std::max(high, glm::dot(along, solid_.vertices[c]));
        }
        return high - low;
    }

    void add_lengths(const std::vector<int>& crown) {
        const double mm = 1 / mm_per(stone_.unit);
        const std::string unit(name_of(stone_.unit));
        std::vector<int> all(solid_.vertices.size());
        for (std::size_t v = 0; v < all.size(); ++v) all[v] = static_cast<int>(v);
        const std::vector<double> azimuths = directions(caliper_widths(solid_, stone_.up), crown);
        const auto of = [](double azimuth) { return fmt::format("{:g}", azimuth); };
        for (const double azimuth : azimuths) {
            const std::string one = facet_towards(azimuth, crown),
                              other = facet_towards(azimuth + 180, crown);
            row("width", of(azimuth), sigmas_.caliper_mm * mm,
                fmt::format("expected {:.4g} {}{}", extent(all, azimuth), unit,
                            one.empty() || other.empty()
                                ? std::string()
                                : fmt::format(" (jaws at {} and {})", one, other)));
        }
        row("depth", "", sigmas_.caliper_mm * mm,
            fmt::format("expected {:.4g} {} (from the table to the lowest point)",
                        width_along(solid_, stone_.up), unit));
        for (std::size_t i = 0; i < azimuths.size() && table_ >= 0; i += 2) {
            row("table_width", of(azimuths[i]), sigmas_.table_mm * mm,
                fmt::format("expected {:.4g} {} (from end to end of the table)",
                            extent(solid_.facets[table_].corners, azimuths[i]), unit));
        }
        const auto density = stone_.material.density_g_cm3;
        const double mm3 = volume(solid_) * std::pow(mm_per(stone_.unit), 3);
        row("weight", "", sigmas_.scale_ct,
            has_material_ && density
                ? fmt::format("expected {:.4g} ct as {}", carat(mm3, *density), stone_.material.id)
                : "in carat (the stone file must name the material or the density)");
    }

    std::string instructions() const {
        const std::string unit(name_of(stone_.unit));
        std::string text =
            "# Write what you read into the column value, and leave empty what you did not read: "
            "empty rows are skipped.\n";
        text += fmt::format(
            "# inclination: degrees from {} (0) to the girdle (90), the same way on crown and "
            "pavilion. Lengths are in {}, weight in carat; a unit may stand beside the number "
            "(6.52 mm, 33.8 deg, 1.05 ct).\n",
            table_ >= 0 ? "the table" : "the horizontal", unit);
        text +=
            "# width and table_width: the number beside them is the direction from jaw to jaw, in "
            "degrees counter-clockwise seen from above; 0 is the mesh's x.\n";
        text +=
            "# sigma: what your instrument may be off by (one standard deviation); change it where "
            "you know better. note: what the mesh would read.\n";
        if (gear_ == 0) return text;
        text += fmt::format(
            "# index: the tooth under the facet on a wheel of {:g}, as GemCad counts. Facets may "
            "be "
            "named by tier and index, such as A@76.\n",
            std::abs(gear_));
        return text;
    }

    const Stone& stone_;
    const Solid& solid_;
    bool has_material_;
    BenchSigmas sigmas_;
    PlanFrame frame_;
    int table_;
    std::vector<std::string> names_, teeth_;  // by index
    double gear_;
    std::vector<FormRow> rows_;
};

}  // namespace

ReadingsForm readings_form(const Stone& stone, bool has_material, double gear,
                           const BenchSigmas& sigmas) {
    return FormWriter(stone, has_material, gear, sigmas).form();
}

}  // namespace culet
