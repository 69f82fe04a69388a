#include "page/facet_labels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "stone/solid/plan.h"

namespace culet {

namespace {

// In units of the drawing, which is 1000 across.
constexpr double k_largest = 34, k_smallest = 17;
constexpr double k_led = 22, k_least_led = 11;
constexpr double k_gap = 26;         // between drawing and led names
constexpr double k_letter = 0.74;    // width of a capital of a bold sans-serif
constexpr double k_line = 0.95;      // height of a line
constexpr double k_turn_gain = 1.3;  // a turned name must be larger by this factor
constexpr std::size_t k_longest = 14;

// At most so many characters (of UTF-8: bytes that begin one).
std::string shortened(const std::string& name) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if ((static_cast<unsigned char>(name[i]) & 0xc0) == 0x80) continue;
        if (++count > k_longest) return name.substr(0, i) + "…";
    }
    return name;
}

double letters(const std::string& text) {
    return static_cast<double>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

struct Fitted {
    glm::dvec2 at{0, 0};
    double size = 0;
};

glm::dvec2 centre_of(const std::vector<glm::dvec2>& corners) {
    const double area = area_of(corners);
    glm::dvec2 sum(0, 0), mean(0, 0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
        sum += (a + b) * (a.x * b.y - a.y * b.x);
        mean += a / static_cast<double>(corners.size());
    }
    return std::abs(area) > 1e-9 ? sum / (6 * area) : mean;
}

// The largest box of the given proportions (half width, half height, at size 1) in a polygon, in
// the box's own frame. Its size is the least over the edges of distance / reach, which is concave
// in the box's middle; a pattern search maximises it. Distance from the facet's middle costs a
// little; size beyond a name's largest gains nothing.
Fitted largest_box(const std::vector<glm::dvec2>& corners, double half_width, double half_height) {
    struct Side {
        glm::dvec2 inward;
        double offset, reach;
    };
    std::vector<Side> sides;
    const double turn = area_of(corners) >= 0 ? 1 : -1;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], along = corners[(i + 1) % corners.size()] - a;
        const double length = glm::length(along);
        if (!(length > 0)) continue;
        const glm::dvec2 inward = turn * glm::dvec2(-along.y, along.x) / length;
        sides.push_back({inward, glm::dot(inward, a),
                         std::abs(inward.x) * half_width + std::abs(inward.y) * half_height});
    }
    const auto size_at = [&](const glm::dvec2& at) {
        double size = std::numeric_limits<double>::max();
        for (const Side& side : sides) {
            size = std::min(size, (glm::dot(side.inward, at) - side.offset) / side.reach);
        }
        return size;
    };
    const glm::dvec2 centre = centre_of(corners);
    const auto worth = [&](const Fitted& f) {
        return std::min(f.size, k_largest) - 0.02 * glm::length(f.at - centre);
    };
    Fitted best{centre, size_at(centre)};
    for (double step = 64; step > 0.5; step /= 2) {
        for (int moves = 0; moves < 12; ++moves) {
            Fitted next = best;
            for (int k = 0; k < 8; ++k) {
                const double angle = k * std::numbers::pi / 4;
                const glm::dvec2 at = best.at + step * glm::dvec2(std::cos(angle), std::sin(angle));
                const Fitted there{at, size_at(at)};
                if (worth(there) > worth(next)) next = there;
            }
            if (!(worth(next) > worth(best))) break;
            best = next;
        }
    }
    return best;
}

glm::dvec2 turned(const glm::dvec2& p, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

// Direction in which the corners scatter most; text along it reads from left to right.
double long_axis(const std::vector<glm::dvec2>& corners) {
    const glm::dvec2 centre = centre_of(corners);
    double xx = 0, xy = 0, yy = 0;
    for (const auto& c : corners) {
        const glm::dvec2 d = c - centre;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    return 0.5 * std::atan2(2 * xy, xx - yy);  // -pi/2 .. pi/2
}

FacetLabel inside(const SeenFacet& seen, const std::string& text) {
    const double half_width = 0.5 * k_letter * std::max(1.0, letters(text)) + 0.15;
    FacetLabel label;
    label.facet = seen.facet;
    label.text = text;
    Fitted level = largest_box(seen.corners, half_width, 0.5 * k_line);
    label.at = level.at;
    label.size = level.size;
    if (level.size >= 0.8 * k_largest) return label;
    const double angle = long_axis(seen.corners);
    std::vector<glm::dvec2> corners;
    for (const auto& c : seen.corners) corners.push_back(turned(c, -angle));
    const Fitted along = largest_box(corners, half_width, 0.5 * k_line);
    const double needed = level.size < k_smallest ? 1.0 : k_turn_gain;
    if (along.size > needed * level.size && along.size >= k_smallest) {
        label.at = turned(along.at, angle);
        label.size = along.size;
        label.turn_deg = angle * 180 / std::numbers::pi;
    }
    return label;
}

// Stacks the names of one side in the order of their feet, at least one line apart.
double stack(std::vector<FacetLabel*>& column, double height) {
    if (column.empty()) return 0;
    const double size = std::min(k_led, height / (1.12 * static_cast<double>(column.size())));
    if (size < k_least_led) {
        // No room: drop the rest, in any order, since large facets have their names inside.
        const auto keep = static_cast<std::size_t>(height / (1.12 * k_least_led));
        for (std::size_t i = keep; i < column.size(); ++i) column[i]->size = 0;
        column.resize(keep);
    }
    const double line = 1.12 * std::max(size, k_least_led);
    std::stable_sort(column.begin(), column.end(), [](const FacetLabel* a, const FacetLabel* b) {
        return a->foot.y < b->foot.y;
    });
    double lowest = 0.5 * line;
    for (FacetLabel* label : column) {
        label->at.y = std::max(label->foot.y, lowest);
        lowest = label->at.y + line;
    }
    double highest = height - 0.5 * line;
    for (auto it = column.rbegin(); it != column.rend(); ++it) {
        (*it)->at.y = std::min((*it)->at.y, highest);
        highest = (*it)->at.y - line;
    }
    double widest = 0;
    for (FacetLabel* label : column) {
        label->size = line / 1.12;
        widest = std::max(widest, k_letter * label->size * letters(label->text));
    }
    return widest + k_gap;
}

}  // namespace

FacetLabels place_labels(const Solid& solid, const FacetView& view) {
    FacetLabels result;
    for (const SeenFacet& seen : view.facets) {
        const std::string text = shortened(solid.facets[static_cast<std::size_t>(seen.facet)].name);
        if (text.empty()) continue;
        FacetLabel label = inside(seen, text);
        if (label.size < k_smallest) {
            label.has_leader = true;
            label.turn_deg = 0;
            label.foot = centre_of(seen.corners);
            label.at_right = label.foot.x > 0.5 * view.width;
        }
        label.size = std::min(label.size, k_largest);
        result.labels.push_back(std::move(label));
    }
    std::vector<FacetLabel*> left, right;
    for (FacetLabel& label : result.labels) {
        if (label.has_leader) (label.at_right ? right : left).push_back(&label);
    }
    result.left = stack(left, view.height);
    result.right = stack(right, view.height);
    for (FacetLabel& label : result.labels) {
        if (label.has_leader) label.at.x = label.at_right ? view.width + k_gap : -k_gap;
    }
    std::erase_if(result.labels, [](const FacetLabel& label) { return !(label.size > 0); });
    return result;
}

}  // namespace culet
