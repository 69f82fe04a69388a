#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <set>

#include "stone/design/design.h"
#include "stone/mesh/face_soup.h"

namespace culet {

std::vector<std::string> unique_names(std::vector<std::string> names,
                                      const std::vector<std::string>& of_tier) {
    const std::set<std::string> given(names.begin(), names.end());
    std::set<std::string> taken;
    std::map<std::string, int> repetitions;
    const auto next_of = [&](const std::string& name) {
        int& count = repetitions[name];
        std::string next;
        do {
            next = fmt::format("{}.{}", name, ++count);
        } while (given.contains(next) || taken.contains(next));
        return next;
    };
    const auto inherits = [&](std::size_t i) {
        return names[i].empty() && i < of_tier.size() && !of_tier[i].empty();
    };
    // Names from the file have precedence over names from tiers.
    std::vector<std::size_t> heirs;
    int unnamed = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (inherits(i)) {
            heirs.push_back(i);
            continue;
        }
        std::string& name = names[i];
        if (name.empty()) {
            do {
                name = fmt::format("f{}", unnamed++);
            } while (given.contains(name));
        } else if (taken.contains(name)) {
            name = next_of(name);
        }
        taken.insert(name);
    }
    for (const std::size_t i : heirs) {
        const std::string& tier = of_tier[i];
        names[i] = given.contains(tier) || taken.contains(tier) ? next_of(tier) : tier;
        taken.insert(names[i]);
    }
    return names;
}

std::string writable_name(std::string_view name) {
    std::string text(trimmed(name));
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        const bool after_blank = i == 0 || text[i - 1] == ' ';
        if (c < 0x20 || c == 0x7f || (c == '#' && after_blank) || c == '\\') text[i] = '_';
    }
    return text;
}

std::uint64_t corner_hash(const std::vector<Vec3>& vertices,
                          const std::vector<const std::vector<int>*>& outlines) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) {
            hash = (hash ^ ((word >> (8 * byte)) & 0xff)) * 0x100000001b3u;
        }
    };
    for (const Vec3& vertex : vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            const double value = vertex[axis] + 0.0;  // -0 and 0 are one place
            std::uint64_t bits = 0;
            std::memcpy(&bits, &value, sizeof bits);
            add(bits);
        }
    }
    for (const std::vector<int>* outline : outlines) {
        add(outline->size());
        for (const int corner : *outline) add(static_cast<std::uint64_t>(corner));
    }
    return hash;
}

void read_comment(FaceSoup& soup, std::string_view comment) {
    const std::vector<std::string_view> words = words_of(comment);
    // As 3ds Max and Rhinoceros write it: `File units = meters`.
    constexpr std::string_view k_units[] = {"m",    "meters",      "metres", "meter",
                                            "cm",   "centimeters", "in",     "inches",
                                            "inch", "centimetres"};
    if (words.size() > 1 && words.size() <= 6 &&
        lower_case(std::string(comment)).find("unit") != std::string::npos &&
        std::find(std::begin(k_units), std::end(k_units), lower_case(std::string(words.back()))) !=
            std::end(k_units)) {
        soup.notes.push_back(
            fmt::format("a comment says '{}': name that unit in the stone file (unit = \"m\", "
                        "\"cm\", \"in\"); without it mm is assumed",
                        shown(trimmed(comment))));
    }
    if (words.size() < 3 || words[0] != "culet") return;
    if (words[1] == "corners" && words[2].size() == 16) {
        std::uint64_t hash = 0;
        for (const char c : words[2]) {
            const bool digit = c >= '0' && c <= '9', letter = c >= 'a' && c <= 'f';
            if (!digit && !letter) return;
            hash = hash * 16 + static_cast<std::uint64_t>(digit ? c - '0' : c - 'a' + 10);
        }
        soup.corner_hash = hash;
    } else if (words[1] == "asc") {
        const char* const line = words[2].data();
        soup.design.append(line, static_cast<std::size_t>(comment.data() + comment.size() - line));
        soup.design += '\n';
    } else if (words[1] == "plane" && words.size() >= 6) {
        double numbers[4];
        for (std::size_t i = 0; i < 4; ++i) {
            const auto number = number_in(words[words.size() - 4 + i]);
            if (!number) return;
            numbers[i] = *number;
        }
        NamedPlane plane;
        plane.plane.normal = {numbers[0], numbers[1], numbers[2]};
        plane.plane.offset = numbers[3];
        // Another program's plane may not be normalised; one without direction is ignored.
        const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
        if (!(length > 0) || !std::isfinite(length)) return;
        if (std::abs(length - 1) > 1e-15) {
            plane.plane.normal /= length;
            plane.plane.offset /= length;
        }
        // The name is what stands between and may contain blanks.
        if (words.size() > 6) {
            const char* const start = words[2].data();
            const std::string_view last = words[words.size() - 5];
            plane.name.assign(start, static_cast<std::size_t>(last.data() + last.size() - start));
        }
        soup.planes.push_back(std::move(plane));
    }
}

std::string plane_comments(const Solid& solid, std::string_view sign) {
    std::vector<const std::vector<int>*> outlines;
    for (const Facet& facet : solid.facets) outlines.push_back(&facet.corners);
    std::string text =
        fmt::format("{}culet corners {:016x}\n", sign, corner_hash(solid.vertices, outlines));
    for (const Facet& facet : solid.facets) {
        const Vec3& n = facet.plane.normal;
        text += fmt::format("{}culet plane {} {} {} {} {}\n", sign, writable_name(facet.name), n.x,
                            n.y, n.z, facet.plane.offset);
    }
    if (!solid.design) return text;
    const std::string design = design_text(*solid.design);
    LineReader lines(design);
    while (const auto line = lines.next()) text += fmt::format("{}culet asc {}\n", sign, *line);
    return text;
}

}  // namespace culet
