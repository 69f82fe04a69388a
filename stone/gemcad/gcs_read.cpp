// Reads Gem Cut Studio's .gcs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <pugixml.hpp>

#include "stone/design/repeating_gear.h"
#include "stone/gemcad/cut_planes.h"
#include "stone/gemcad/gcs_unread.h"
#include "stone/gemcad/gcs_words.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr long k_known_version = 1000;
/// Degrees by which a tier's angle, or a facet's index, may differ from its normal without a note.
constexpr double k_same_direction_deg = 1e-3;
/// Corners are computed by Gem Cut Studio and miss their planes by 3e-5.
constexpr double k_corner_off = 1e-3;

class GcsReader {
public:
    GcsReader(const std::string& text, const std::filesystem::path& file)
        : text_(text), file_(file) {}

    void read() {
        const pugi::xml_parse_result parsed = document_.load_buffer(
            text_.data(), text_.size(), pugi::parse_escapes | pugi::parse_eol | pugi::parse_doctype,
            pugi::encoding_utf8);
        if (!parsed) {
            throw InputError(file_, line_at(parsed.offset),
                             fmt::format("is not well-formed XML, as a .gcs is: {}",
                                         lower_case(parsed.description())));
        }
        const pugi::xml_node root = document_.document_element();
        for (const pugi::xml_node node : document_.children()) {
            if (node.type() == pugi::node_doctype)
                fail(node, "a document type is not read: a .gcs has none");
        }
        if (std::string_view(root.name()) != "GemCutStudio") {
            fail(root, "is not a Gem Cut Studio design: one begins with <GemCutStudio, found <" +
                           shown(root.name()));
        }
        if (number(root, "version").value_or(0) > k_known_version) {
            cut.notes.push_back(
                fmt::format("is of a newer Gem Cut Studio (version {}): what {} lacks is not read",
                            shown(root.attribute("version").value()), k_known_version));
        }
        read_gear(root);
        note_unread(root);
        for (const pugi::xml_node node : root.children()) {
            const std::string_view name = node.name();
            if (name == "tier") {
                read_tier(node);
            } else if (name == "render" || name == "info") {
                keep(node);
                keep(node.child("color"));
            }
        }
        take_words();
        tell();
    }

    // The file's own is that of the tier that was cut last.
    void find_symmetry() {
        constexpr double k_per_depth = 1e5;
        std::map<std::pair<int, long>, DesignTier> apart;  // tiers of one depth
        for (const CutPlane& plane : planes) {
            const DesignTier& tier = design.tiers[std::size_t(plane.tier)];
            DesignTier& own = apart[{plane.tier, std::lround(k_per_depth * plane.plane.offset)}];
            own.setting = tier.setting;
            own.facets.push_back(tier.facets[std::size_t(plane.facet)]);
        }
        Design whole;
        whole.gear = design.gear;
        for (auto& [key, tier] : apart) whole.tiers.push_back(std::move(tier));
        state_symmetry(whole);
        design.symmetry = whole.symmetry;
        design.mirror = whole.mirror;
    }

    ReadCut cut;  // collects the notes
    Design design;
    std::vector<CutPlane> planes;

private:
    long line_at(std::ptrdiff_t offset) const {
        const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text_));
        return 1 + std::count(text_.begin(), end, '\n');
    }

    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
        throw InputError(file_, line_at(node.offset_debug()), what);
    }

    std::optional<double> number(const pugi::xml_node& node, const char* key) const {
        const pugi::xml_attribute written = node.attribute(key);
        if (!written) return std::nullopt;
        const auto value = number_in(trimmed(written.value()));
        if (!value || std::abs(*value) > 1e9) {
            fail(node, fmt::format("{} of <{}> is '{}': expected a number", key, node.name(),
                                   shown(written.value())));
        }
        return value;
    }

    void note_unread(const pugi::xml_node& root) {
        const GcsUnread unread = gcs_unread(root);
        if (unread.curved) {
            fail(unread.curved,
                 fmt::format("tier '{}' is not flat ({}), and culet cuts flat facets: give it flat "
                             "ones, or hide it (visible=\"false\")",
                             shown(unread.curved.attribute("name").value()), unread.curved_by));
        }
        for (const std::string& what : {unread.elements, unread.attributes})
            if (!what.empty()) cut.notes.push_back("not read, because unknown: " + what);
    }

    void read_gear(const pugi::xml_node& root) {
        const pugi::xml_node index = root.child("index");
        const auto gear = number(index, "gear");
        if (!gear || !(*gear >= 1) || *gear > 1e6 || *gear != std::floor(*gear)) {
            fail(index ? index : root,
                 "gives no gear: expected one of whole teeth in its index, such as gear=\"96\"");
        }
        design.gear = *gear;
        keep(index);
    }

    void keep(const pugi::xml_node& node) {
        for (const pugi::xml_attribute own : node.attributes())
            design.studio[fmt::format("{}.{}", node.name(), own.name())] = own.value();
    }

    void read_tier(const pugi::xml_node& node) {
        const auto polar = number(node, "angle");
        if (!polar || *polar < 0 || *polar > 180)
            fail(node, "a tier needs its angle, 0 (table) to 180 (flat culet) degrees");
        if (!node.child("facet")) fail(node, "a tier has no facet");
        const auto depth = number(node, "depth");
        const double frosting = number(node, "frosting").value_or(0);
        for (const pugi::xml_node own : node.children("facet")) {
            const Plane plane = plane_of_facet(own, *polar, depth);
            DesignTier tier = new_tier(node, plane, *polar);
            tier.frosting = std::max(0.0, number(own, "frosting").value_or(frosting));
            const std::string name = node.attribute("name").value();
            if (design.tiers.empty() || !goes_on(tier, name, node)) {
                design.tiers.push_back(std::move(tier));
                design.tiers.back().facets.push_back({0, name, {}});
                last_ = node;
            } else {
                if (design.tiers.back().instruction.empty())
                    design.tiers.back().instruction = std::move(tier.instruction);
                design.tiers.back().facets.emplace_back();
            }
            DesignFacet& facet = design.tiers.back().facets.back();
            facet.index = without_noise(setting_of(plane, design).index);
            if (design.tiers.back().hidden) continue;
            planes.push_back({plane, facet.label,
                              fmt::format("tier {} ({:.6g} degrees), index {:g}",
                                          design.tiers.size(), *polar, facet.index),
                              int(design.tiers.size()) - 1,
                              int(design.tiers.back().facets.size()) - 1});
        }
    }

    // A tier has one depth: of an oblong stone, one of several depths takes several of one name.
    bool goes_on(const DesignTier& tier, const std::string& name,
                 const pugi::xml_node& node) const {
        const DesignTier& last = design.tiers.back();
        const bool alike = tier.frosting == last.frosting && tier.hidden == last.hidden &&
                           tier.guide == last.guide &&
                           tier.setting.pavilion == last.setting.pavilion;
        if (node == last_) return alike;
        return alike && !name.empty() && name == last.facets.front().label &&
               (last.instruction.empty() || last.instruction == tier.instruction);
    }

    DesignTier new_tier(const pugi::xml_node& node, const Plane& plane, double polar) {
        DesignTier tier;
        tier.setting = setting_of(plane, design);
        const double angle = polar > 90 ? 180 - polar : polar;
        if (std::abs(angle - tier.setting.angle_deg) < k_same_direction_deg) {
            tier.setting.angle_deg = angle;
        } else {
            ++other_angles_;
        }
        tier.setting.angle_deg = without_noise(tier.setting.angle_deg);
        tier.instruction = trimmed(node.attribute("instructions").value());
        const auto says = [&](const char* key, const char* word, const char* digit) {
            const std::string value = lower_case(node.attribute(key).value());
            return value == word || value == digit;
        };
        tier.hidden = says("visible", "false", "0");
        tier.guide = says("guide", "true", "1");
        return tier;
    }

    Plane plane_of_facet(const pugi::xml_node& node, double polar,
                         const std::optional<double>& depth) {
        const auto index_angle = number(node, "index_angle");
        const auto x = number(node, "nx"), y = number(node, "ny"), z = number(node, "nz");
        Plane plane;
        if (x && y && z) {
            const double length = std::hypot(*x, *y, *z);
            if (!(length > 1e-9)) fail(node, "a normal of length 0");
            plane.normal = gcs_turned({*x / length, *y / length, *z / length});
            const bool level = std::hypot(*x, *y) < 1e-9 * length;
            if (index_angle && !level &&
                std::abs(std::remainder(*index_angle - gcs_index_angle(plane.normal), 360)) >
                    k_same_direction_deg)
                ++other_indices_;
        } else if (index_angle && !x && !y && !z) {
            Design degrees;
            degrees.gear = polar < 90 - 1e-6 ? 360 : -360;
            plane =
                plane_of({polar > 90 ? 180 - polar : polar, polar > 90, 0, *index_angle}, degrees);
        } else {
            fail(node, "a facet needs its normal (nx, ny, nz), or its index_angle");
        }
        double sum = 0, worst = 0;
        int corners = 0;
        for (const pugi::xml_node corner : node.children("vertex")) {
            const auto u = number(corner, "x"), v = number(corner, "y"), w = number(corner, "z");
            if (!u || !v || !w) fail(corner, "a vertex needs x, y and z");
            const double height = glm::dot(plane.normal, gcs_turned({*u, *v, *w}));
            sum += height;
            worst = std::max(worst, std::abs(height - depth.value_or(height)));
            ++corners;
        }
        if (!depth && corners == 0) fail(node, "neither the tier's depth nor a vertex is given");
        plane.offset = depth ? *depth : sum / corners;
        other_corners_ += worst > k_corner_off;
        return plane;
    }

    void take_words() {
        const auto taken = [&](const std::string& key) {
            const auto found = design.studio.extract(key);
            return found ? std::string(trimmed(found.mapped())) : std::string();
        };
        if (const auto index = number_in(taken("render.refractive_index")); index && *index >= 1)
            design.refractive_index = *index;
        const auto lines = [&](auto keys, std::vector<std::string>& out) {
            for (const char* key : keys) out.push_back(taken(std::string("info.") + key));
            LineReader last(out.back());
            std::vector<std::string> more;
            while (const auto line = last.next()) more.emplace_back(*line);
            out.pop_back();
            out.insert(out.end(), more.begin(), more.end());
            while (!out.empty() && out.back().empty()) out.pop_back();
        };
        lines(k_gcs_headings, design.headings);
        lines(k_gcs_footnotes, design.footnotes);
    }

    void tell() {
        const auto say_tiers = [&](const char* words, auto which) {
            std::string names;
            const std::vector<std::string> titles = tier_titles(design);
            for (std::size_t t = 0; t < titles.size(); ++t) {
                if (which(design.tiers[t])) names += (names.empty() ? "" : ", ") + titles[t];
            }
            if (!names.empty()) cut.notes.push_back(words + names);
        };
        if (const std::string frosted = frosted_tiers(design); !frosted.empty())
            cut.notes.push_back("frosted: " + frosted);
        say_tiers("not cut, because the file hides them: ",
                  [](const DesignTier& tier) { return tier.hidden; });
        const auto say_count = [&](int count, const char* what) {
            if (count > 0) cut.notes.push_back(fmt::format("{} {}", count, what));
        };
        say_count(other_angles_,
                  "tiers have another angle than their facets' normals, which count");
        say_count(other_indices_,
                  "facets have another index_angle than their normals, which count");
        say_count(other_corners_, "facets have corners off their planes, which count");
    }

    const std::string& text_;
    const std::filesystem::path& file_;
    pugi::xml_document document_;
    pugi::xml_node last_;  // of the last of the design's tiers
    int other_angles_ = 0, other_indices_ = 0, other_corners_ = 0;
};

}  // namespace

ReadCut parse_gcs(std::string_view bytes, const CutReading& how,
                  const std::filesystem::path& file) {
    const std::string text = decoded_text(bytes, file);
    if (trimmed(text).empty()) throw InputError(file, "is empty");
    GcsReader reader(text, file);
    reader.read();
    reader.find_symmetry();
    build_solid(reader.cut, std::move(reader.design), reader.planes, how, file);
    return std::move(reader.cut);
}

}  // namespace culet
