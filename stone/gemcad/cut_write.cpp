// Writes cut designs, and reads them back before they count as written.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "stone/design/design_difference.h"
#include "stone/gemcad/cut_text.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/gemcad/gemcad_lines.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

/// Quartz, GemCad's default.
constexpr double k_gemcads_index = 1.54;
/// Of the width.
constexpr double k_planes_read_back = 1e-9;

std::string asc_line(const CutLine& tier) {
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
        const std::string& label = tier.labels[i];
        add(tier.indices[i] + (label.empty() ? "" : " n " + label));
    }
    if (tier.ends_tier && !tier.tier->instruction.empty())
        return out + line + " " + gemcad_line('G', tier.tier->instruction);
    return out + line + "\n";
}

// GemCad writes this many headings, and as many footnotes, in a .gem.
constexpr std::size_t k_gem_lines = 4;

class GemBytes {
public:
    void number(double value) { little_endian(std::bit_cast<std::uint64_t>(value), 8); }
    void integer(std::int32_t value) { little_endian(static_cast<std::uint32_t>(value), 4); }
    /// At most 255 bytes.
    void text(const std::string& words) {
        const std::string held = words.substr(0, 255);
        little_endian(held.size(), 1);
        bytes += held;
    }
    std::string bytes;

private:
    void little_endian(std::uint64_t word, int size) {
        for (int i = 0; i < size; ++i) bytes.push_back(static_cast<char>(word >> (8 * i)));
    }
};

std::string one_line(const std::string& text) {
    const std::string line = gemcad_line(' ', text);
    return line.substr(2, line.size() - 3);
}

std::string plain_name(const std::string& name) {
    return std::string(trimmed(name));
}

struct Placed {
    Solid solid;
    Design design;
};

Placed placed(const Solid& solid, Design design, const Vec3& by, double scale) {
    for (DesignTier& tier : design.tiers) {
        CutSetting& cut = tier.setting;
        cut.distance = scale * (cut.distance + by.z * plane_of(cut, design).normal.z);
    }
    Placed out{solid, std::move(design)};
    for (Vec3& v : out.solid.vertices) v = scale * (v + by);
    for (Facet& facet : out.solid.facets)
        facet.plane.offset = scale * (facet.plane.offset + glm::dot(facet.plane.normal, by));
    return out;
}

Placed for_gemcad(const Solid& solid, Design design, std::vector<std::string>& notes) {
    std::erase_if(design.tiers, [](const DesignTier& tier) { return tier.hidden; });
    if (!design.refractive_index) design.refractive_index = k_gemcads_index;
    const double margin = 1e-6 * diameter(solid);
    if (std::all_of(solid.facets.begin(), solid.facets.end(),
                    [&](const Facet& facet) { return facet.plane.offset > margin; }))
        return {solid, std::move(design)};
    const Vec3 by = -centroid(solid);
    notes.push_back(
        fmt::format("moved by ({}, {}, {}), because GemCad measures from a point inside the stone",
                    by.x, by.y, by.z));
    design.footnotes.push_back(notes.back());
    return placed(solid, std::move(design), by, 1);
}

Placed for_gcs(const Solid& solid, const Design& design, std::vector<std::string>& notes) {
    Vec3 low(INFINITY), high(-INFINITY);
    for (const Vec3& v : solid.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    Vec3 by(0, 0, -(low.z + high.z) / 2);
    const bool axis_inside = low.x < 0 && high.x > 0 && low.y < 0 && high.y > 0;
    if (!axis_inside) {
        by = -(low + high) / 2.0;
        notes.push_back(fmt::format("moved by ({}, {}) onto its axis", by.x, by.y));
    }
    double reach = (high.z - low.z) / 2;
    for (const int axis : {0, 1})
        reach = std::max({reach, high[axis] + by[axis], -low[axis] - by[axis]});
    return placed(solid, design, by, 1 / reach);
}

// The design with all facets of these lines.
Design design_of(const std::vector<CutLine>& lines, const Placed& placed) {
    Design design = placed.design;
    design.tiers.clear();
    const DesignTier* last = nullptr;
    for (const CutLine& line : lines) {
        if (line.tier == nullptr || line.tier != last) {
            design.tiers.push_back(line.tier == nullptr ? DesignTier() : *line.tier);
            design.tiers.back().facets.clear();
        }
        last = line.tier;
        DesignTier& tier = design.tiers.back();
        if (line.tier == nullptr) tier.setting = line.setting;
        for (std::size_t i = 0; i < line.facets.size(); ++i) {
            const int f = line.facets[i];
            tier.facets.push_back({number_in(line.indices[i]).value_or(0), line.labels[i],
                                   f < 0 ? "" : placed.solid.facets[std::size_t(f)].name});
        }
    }
    return design;
}

// Every plane of the written file must be one of the solid's.
void compare(const Solid& written, const Solid& read, std::vector<std::string>& notes) {
    const double size = diameter(written);
    std::vector<std::string> renamed;
    for (const Facet& facet : read.facets) {
        const Facet* nearest = nullptr;
        double least = INFINITY;
        for (const Facet& own : written.facets) {
            const double off = std::max(glm::length(own.plane.normal - facet.plane.normal),
                                        std::abs(own.plane.offset - facet.plane.offset) / size);
            if (off < least) nearest = &own;
            least = std::min(least, off);
        }
        check(least <= k_planes_read_back, "a written design reads back with other planes");
        if (nearest->name != facet.name && !nearest->name.empty())
            renamed.push_back(fmt::format("{} is {}", nearest->name, facet.name));
    }
    if (read.facets.size() < written.facets.size()) {
        notes.push_back(fmt::format("{} facets vanish when meets that miss are joined on reading",
                                    written.facets.size() - read.facets.size()));
    }
    constexpr std::size_t k_shown = 3;
    const std::size_t count = renamed.size();
    if (count > k_shown) renamed.resize(k_shown);
    if (count > 0) {
        notes.push_back(fmt::format("not kept: names of {} facets: {}{}", count,
                                    fmt::join(renamed, ", "), count > k_shown ? ", ..." : ""));
    }
}

}  // namespace

std::string asc_text(const Design& design, const std::vector<CutLine>& lines) {
    std::string out = gemcad_head(design, design.refractive_index);
    for (const CutLine& line : lines) out += asc_line(line);
    return out + gemcad_feet(design);
}

std::string gem_bytes(const Solid& solid, const Design& design, const std::vector<CutLine>& lines) {
    GemBytes out;
    for (std::size_t l = 0; l < lines.size(); ++l) {
        const CutLine& line = lines[l];
        for (std::size_t i = 0; i < line.facets.size(); ++i) {
            const Plane plane = line.plane(i, solid, design);
            for (const int axis : {0, 1, 2}) out.number(plane.normal[axis] / plane.offset);
            out.integer(int(l) + 1);
            out.text(one_line(line.labels[i]) + "\t" +
                     (line.ends_tier ? one_line(line.tier->instruction) : ""));
            if (line.facets[i] >= 0) {
                for (const int corner : solid.facets[std::size_t(line.facets[i])].corners) {
                    out.integer(1);
                    for (const int axis : {0, 1, 2})
                        out.number(solid.vertices[std::size_t(corner)][axis]);
                }
            }
            out.integer(0);
        }
    }
    out.number(-99999.0);
    out.integer(design.symmetry);
    out.integer(design.mirror ? 1 : 0);
    out.integer(int(std::lround(design.gear)));
    out.number(design.refractive_index.value_or(0));
    out.integer(32767);  // in all files that we know
    out.number(design.gear_offset);
    for (const auto& lines_of : {design.headings, design.footnotes}) {
        for (std::size_t i = 0; i < k_gem_lines; ++i)
            out.text(i < lines_of.size() ? one_line(lines_of[i]) : "");
    }
    return std::move(out.bytes);
}

CutFile cut_file(const Solid& solid, const Design& design, const std::filesystem::path& file) {
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
    const std::string format = extension_of(file);
    std::vector<std::string> notes;
    Placed own = format == "gcs" ? for_gcs(solid, design, notes) : for_gemcad(solid, design, notes);
    const std::vector<CutLine> lines = cut_lines(own.solid, own.design,
                                                 format == "asc"   ? LineShares::setting
                                                 : format == "gem" ? LineShares::tier
                                                                   : LineShares::distance,
                                                 format == "asc" ? gemcad_word : plain_name);
    std::string bytes = format == "gcs"   ? gcs_text(own.solid, own.design, lines)
                        : format == "gem" ? gem_bytes(own.solid, own.design, lines)
                                          : asc_text(own.design, lines);
    const Solid read = parse_cut(bytes, {}, file).solid;
    compare(own.solid, read, notes);
    // What the format cannot hold, hidden tiers among it.
    Design whole = design_of(lines, own);
    if (format != "gcs") {
        for (const DesignTier& tier : design.tiers) {
            if (tier.hidden) whole.tiers.push_back(tier);
        }
    }
    own.solid.design = std::make_shared<const Design>(std::move(whole));
    constexpr std::size_t k_most_notes = 20;
    const std::vector<DesignDifference> lost = design_differences(own.solid, read);
    for (std::size_t i = 0; i < std::min(lost.size(), k_most_notes); ++i)
        notes.push_back("not kept: " + words_of(lost[i]));
    if (lost.size() > k_most_notes) {
        notes.push_back(
            fmt::format("not kept: {} more, see culet info --diff", lost.size() - k_most_notes));
    }
    return {std::move(bytes), std::move(notes)};
}

std::vector<std::string> write_cut(const Solid& solid, const Design& design,
                                   const std::filesystem::path& file) {
    CutFile written = cut_file(solid, design, file);
    write_text(file, written.bytes);
    return std::move(written.notes);
}

}  // namespace culet
