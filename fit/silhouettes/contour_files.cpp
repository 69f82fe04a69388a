#include "fit/silhouettes/contour_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "fit/silhouettes/silhouette.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

using Json = nlohmann::json;

constexpr std::size_t k_most_contours = 100000, k_most_points = 20000000;
constexpr double k_farthest = 1e6;  // no stone's outline lies so far out, in any unit
// In polygons with fewer corners the sides were measured; a traced outline has hundreds of points.
constexpr std::size_t k_traced = 100;
// Gauss's two-point rule: the two points determine a line as the whole side does.
const double k_gauss = 0.5 - std::sqrt(1.0 / 12);

Vec3 vector_of(const Json& json, const std::string& what) {
    const bool is_vector =
        json.is_array() && json.size() == 3 &&
        std::all_of(json.begin(), json.end(), [](const Json& v) { return v.is_number(); });
    if (!is_vector) throw InputError(what + " must be three numbers, [x, y, z]");
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

double positive_in(const Json& json, const char* key, double otherwise) {
    const auto at = json.find(key);
    if (at == json.end()) return otherwise;
    const double value = at->is_number() ? at->get<double>() : -1;
    if (!(value > 0) || !std::isfinite(value)) {
        throw InputError(fmt::format("`{}` must be a positive number", key));
    }
    return value;
}

Contour contour_of(const Json& json, double to_stone, double sigma) {
    if (!json.is_object()) throw InputError("must be an object with `direction` and `points`");
    if (!json.contains("direction")) throw InputError("has no `direction`");
    const Vec3 direction = vector_of(json["direction"], "`direction`");
    const auto points = json.find("points");
    if (points == json.end() || !points->is_array()) {
        throw InputError("has no list `points` of [x, y, z]");
    }
    if (points->size() > k_most_points) throw InputError("has too many points");
    std::vector<Vec3> corners;
    corners.reserve(points->size());
    for (const Json& p : *points) corners.push_back(to_stone * vector_of(p, "each of `points`"));
    const double own = positive_in(json, "sigma", 0) * to_stone;
    return contour_of_polygon(direction, corners, own > 0 ? own : sigma,
                              positive_in(json, "weight", 1));
}

// The words of a scanner's file; `#` starts a comment line.
class Words {
public:
    Words(std::string_view text, const std::filesystem::path& file) : lines_(text), file_(file) {}

    double number() {
        const std::string_view word = next();
        const auto value = number_in(word);
        if (!value || std::abs(*value) > k_farthest) {
            throw InputError(file_, lines_.line(),
                             fmt::format("'{}' is not a number of a shadow contour", shown(word)));
        }
        return *value;
    }
    long count(const char* of, double most) {
        const double value = number();
        if (!(value >= 0 && value <= most && value == std::floor(value))) {
            throw InputError(file_, lines_.line(),
                             fmt::format("{:g} is not a number of {}", value, of));
        }
        return static_cast<long>(value);
    }
    Vec3 vector() {
        const double x = number(), y = number();
        return {x, y, number()};
    }
    long line() const { return lines_.line(); }

private:
    std::string_view next() {
        while (at_ == words_.size()) {
            const auto line = lines_.next();
            if (!line) {
                throw InputError(file_, "ends in the middle of a contour: the file is cut off");
            }
            at_ = 0;
            words_ = words_of(*line);
            if (!words_.empty() && words_[0].front() == '#') words_.clear();
        }
        return words_[at_++];
    }

    LineReader lines_;
    std::vector<std::string_view> words_;
    std::size_t at_ = 0;
    const std::filesystem::path& file_;
};

void add_side(const Vec3& from, const Vec3& to, double weight, Contour& contour) {
    for (const double part : {k_gauss, 1 - k_gauss}) {
        contour.points.push_back(from + part * (to - from));
        contour.weights.push_back(weight);
    }
}

void make_mean_weight_one(std::vector<Contour>& contours) {
    double sum = 0;
    std::size_t count = 0;
    for (const Contour& c : contours) {
        for (const double w : c.weights) sum += w;
        count += c.weights.size();
    }
    if (!(sum > 0)) return;
    for (Contour& c : contours) {
        for (double& w : c.weights) w *= double(count) / sum;
    }
}

}  // namespace

std::size_t SilhouetteSet::points() const {
    std::size_t count = 0;
    for (const Contour& c : contours) count += c.points.size();
    return count;
}

bool SilhouetteSet::has_sigma() const {
    return std::all_of(contours.begin(), contours.end(),
                       [](const Contour& c) { return c.sigma > 0; });
}

Contour contour_of_polygon(const Vec3& direction, const std::vector<Vec3>& corners, double sigma,
                           double weight) {
    const double length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length)) {
        throw InputError("`direction` must not be the zero vector");
    }
    if (corners.size() < 3) {
        throw InputError(
            fmt::format("an outline needs three points or more; there are {}", corners.size()));
    }
    Contour contour{direction / length, {}, {}, sigma};
    double extent = 0;
    for (const Vec3& p : corners) {
        if (!(std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < k_farthest)) {
            throw InputError("a point of an outline is not a finite number, or far off");
        }
        extent = std::max(extent, glm::length(glm::cross(contour.direction, p - corners[0])));
    }
    if (!(extent > 0)) throw InputError("all points of an outline are one");
    if (corners.size() >= k_traced) {
        contour.points = corners;
        contour.weights.assign(corners.size(), weight);
        return contour;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &from = corners[i], &to = corners[(i + 1) % corners.size()];
        if (glm::length(glm::cross(contour.direction, to - from)) > 0) {
            add_side(from, to, weight, contour);
        }
    }
    return contour;
}

std::vector<Contour> read_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                   double sigma) {
    const Json json = Json::parse(decoded_text(read_text(file), file), nullptr, false);
    if (json.is_discarded()) throw InputError(file, "is not JSON");
    if (!json.is_object() || !json.contains("contours") || !json["contours"].is_array()) {
        throw InputError(file,
                         "has no list `contours`: {\"contours\": [{\"direction\", "
                         "\"points\"}]} is expected");
    }
    double to_stone = 1;
    if (json.contains("unit")) {
        const std::string name = json["unit"].is_string() ? json["unit"].get<std::string>() : "";
        const auto unit = length_unit(name);
        if (!unit) {
            throw InputError(file,
                             fmt::format("unit is \"{}\"; expected mm, cm, m or in", shown(name)));
        }
        to_stone = mm_per(*unit) / mm_per(stone_unit);
    }
    if (json["contours"].empty()) throw InputError(file, "holds no contour");
    if (json["contours"].size() > k_most_contours) throw InputError(file, "has too many contours");
    std::vector<Contour> contours;
    for (const Json& one : json["contours"]) {
        try {
            contours.push_back(contour_of(one, to_stone, sigma));
        } catch (const InputError& error) {
            throw InputError(file, fmt::format("contour {} (counted from 0): {}", contours.size(),
                                               error.what()));
        }
    }
    return contours;
}

ShadowContours read_shadow_contours(const std::filesystem::path& file, LengthUnit stone_unit,
                                    double sigma) {
    const std::string text = decoded_text(read_text(file), file);
    const double to_stone = 1 / mm_per(stone_unit);
    Words words(text, file);
    ShadowContours read;
    const long contours = words.count("contours", double(k_most_contours));
    for (long c = 0; c < contours; ++c) {
        const long sides = words.count("sides", double(k_most_contours));
        Contour contour;
        contour.direction = words.vector();
        const double length = glm::length(contour.direction);
        if (!(length > 0)) {
            throw InputError(file, words.line(), "the normal of a contour's plane is zero");
        }
        contour.direction /= length;
        contour.sigma = sigma;
        for (long s = 0; s < sides; ++s) {
            const double confidence = words.number();
            words.number();  // type
            const Vec3 from = to_stone * words.vector(), to = to_stone * words.vector();
            const double span = glm::length(to - from);
            if (!(confidence > 0)) {
                ++read.sides_left_out;
            } else if (span > 0) {
                // More pixels determine a line better, but they are not independent, so the weight
                // grows more slowly. The root of the length predicts left-out halves of two scanned
                // diamonds' outlines best (rms 0.364 and 0.365 of the scanner's own; with the
                // length 0.452, with neither 0.400 and 0.343: bench_silhouettes).
                add_side(from, to, confidence * std::sqrt(span), contour);
            }
        }
        if (!contour.points.empty()) read.contours.push_back(std::move(contour));
    }
    if (read.contours.empty()) throw InputError(file, "holds no contour with a measured side");
    make_mean_weight_one(read.contours);
    return read;
}

}  // namespace culet
