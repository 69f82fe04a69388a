#include "studio/photograph_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/text/errors.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

constexpr double k_margin = 0.3;  // around the stone, share of its extent
constexpr double k_far = 1e6;     // pixels
constexpr const char* k_no_view = "the outline is not as the page makes it: start it anew";

int divided(int value, int by) {
    return (value + by - 1) / by;
}

PhotoPart with_factor(PhotoPart part, int largest) {
    part.factor = std::max(1, divided(std::max(part.width, part.height), largest));
    part.width /= part.factor;
    part.height /= part.factor;
    return part;
}

std::vector<float> means(const std::vector<float>& values, int width, const PhotoPart& part,
                         int channels) {
    std::vector<float> result;
    if (values.empty()) return result;
    result.reserve(std::size_t(part.width) * std::size_t(part.height) * std::size_t(channels));
    const float share = 1.0f / float(part.factor * part.factor);
    for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < channels * part.width; ++x) {
            const int left = part.x + x / channels * part.factor;
            float sum = 0;
            for (int v = 0; v < part.factor; ++v) {
                const auto row = std::size_t(part.y + y * part.factor + v) * std::size_t(width);
                for (int u = 0; u < part.factor; ++u)
                    sum += values[(row + std::size_t(left + u)) * std::size_t(channels) +
                                  std::size_t(x % channels)];
            }
            result.push_back(share * sum);
        }
    }
    return result;
}

}  // namespace

Json json_of(const StoneView& view) {
    Json turn = Json::array();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) turn.push_back(view.turn[column][row]);
    }
    return {{"turn", turn},
            {"at", {view.at.x, view.at.y}},
            {"scale", view.scale},
            {"nearness", view.nearness},
            {"sight", {view.sight.x, view.sight.y}}};
}

StoneView view_of(const std::string& json, const WireSolid& wire) try {
    const Json read = Json::parse(json);
    const auto numbers = [&](const char* key, std::size_t count) {
        auto values = read.at(key).get<std::vector<double>>();
        const bool good =
            values.size() == count &&
            std::all_of(values.begin(), values.end(), [](double v) { return std::abs(v) < k_far; });
        if (!good) throw InputError(k_no_view);
        return values;
    };
    const std::vector<double> turn = numbers("turn", 9), at = numbers("at", 2),
                              sight = numbers("sight", 2);
    StoneView view;
    view.middle = wire.middle;
    view.at = {at[0], at[1]};
    view.sight = {sight[0], sight[1]};
    view.scale = read.at("scale").get<double>();
    view.nearness = read.at("nearness").get<double>();
    // A rotation again, whatever rounding left of it; never a mirrored one.
    const Vec3 right = glm::normalize(Vec3(turn[0], turn[1], turn[2]));
    const Vec3 away = glm::normalize(glm::cross(right, Vec3(turn[3], turn[4], turn[5])));
    view.turn = glm::transpose(glm::dmat3(right, glm::cross(away, right), away));
    const bool good = view.scale > 0 && view.scale < k_far && view.nearness >= 0 &&
                      view.nearness * wire.diameter < 1 && std::isfinite(right.x) &&
                      std::isfinite(away.x);
    if (!good) throw InputError(k_no_view);
    return view;
} catch (const Json::exception&) {
    throw InputError(k_no_view);
}

Json json_of(const WireSolid& wire) {
    Json corners = Json::array(), facets = Json::array();
    for (const Vec3& v : wire.solid.vertices) {
        const Vec3 from = v - wire.middle;
        corners.push_back({from.x, from.y, from.z});
    }
    for (const Facet& facet : wire.solid.facets) facets.push_back(facet.corners);
    return {{"corners", corners}, {"facets", facets}, {"diameter", wire.diameter}};
}

PhotoPart whole_of(const Photo& photo, int largest) {
    return with_factor({0, 0, photo.width, photo.height}, largest);
}

PhotoPart part_around(const Photo& photo, const WireSolid& wire, const StoneView& view,
                      int largest) {
    const Projection project(view);
    PicturePoint low{k_far, k_far}, high{-k_far, -k_far};
    for (const Vec3& vertex : wire.solid.vertices) {
        const PicturePoint at = project(vertex);
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
    const double margin = k_margin * std::max(high.x - low.x, high.y - low.y);
    const auto within = [](double v, int most) { return int(std::clamp(v, 0.0, double(most))); };
    PhotoPart part;
    part.x = within(low.x - margin, photo.width);
    part.y = within(low.y - margin, photo.height);
    part.width = within(high.x + margin, photo.width) - part.x;
    part.height = within(high.y + margin, photo.height) - part.y;
    return with_factor(part, largest);
}

Photo cut_out(const Photo& photo, const PhotoPart& part) {
    Photo result;  // what is said of the photograph, and only a part of its pixels
    result.saturation = photo.saturation;
    result.photometric = photo.photometric;
    result.not_photometric = photo.not_photometric;
    result.shot = photo.shot;
    result.encoding = photo.encoding;
    result.notes = photo.notes;
    result.width = part.width;
    result.height = part.height;
    const auto mean = [&](const std::vector<float>& values, int channels) {
        return means(values, photo.width, part, channels);
    };
    result.rgb = mean(photo.rgb, 3);
    result.coverage = mean(photo.coverage, 1);
    result.mask = mean(photo.mask, 1);
    result.saturated = mean(photo.saturated, 1);
    return result;
}

StoneView in_part(StoneView view, const PhotoPart& part) {
    const auto moved = [&](const PicturePoint& p) {
        return PicturePoint{(p.x - part.x) / part.factor, (p.y - part.y) / part.factor};
    };
    view.at = moved(view.at);
    view.sight = moved(view.sight);
    view.scale /= part.factor;
    return view;
}

StoneView in_whole(StoneView view, const PhotoPart& part) {
    const auto moved = [&](const PicturePoint& p) {
        return PicturePoint{p.x * part.factor + part.x, p.y * part.factor + part.y};
    };
    view.at = moved(view.at);
    view.sight = moved(view.sight);
    view.scale *= part.factor;
    return view;
}

// The outline is convex, so that it meets each row of pixels in one piece.
std::vector<float> mask_of(const Photo& photo, const WireSolid& wire, const StoneView& view) {
    std::vector<float> mask(std::size_t(photo.width) * std::size_t(photo.height), 0.0f);
    const std::vector<WireEdge> edges = visible_edges(wire, view);
    for (int y = 0; y < photo.height; ++y) {
        double from = k_far, to = -k_far;
        for (const WireEdge& edge : edges) {
            const double a = edge.from.y - y - 0.5, b = edge.to.y - y - 0.5;
            if (!edge.outline || a * b > 0 || a == b) continue;
            const double x = edge.from.x + (edge.to.x - edge.from.x) * a / (a - b);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        for (int x = std::max(0, int(std::ceil(from - 0.5))); x < photo.width && x + 0.5 <= to; ++x)
            mask[std::size_t(y) * std::size_t(photo.width) + std::size_t(x)] = 1;
    }
    return mask;
}

}  // namespace culet
