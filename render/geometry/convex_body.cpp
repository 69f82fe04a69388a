#include "render/geometry/convex_body.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "stone/design/design.h"
#include "stone/solid/perpendicular.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr std::size_t k_block = 8;  // planes

// Margin of confirmation, relative to the stone's size: far above rounding, yet almost no ray
// passes an edge so closely.
constexpr double k_margin = 1e-9;
// Farthest start of a ray, in sizes of the stone; beyond it rounding approaches the margin.
constexpr double k_far = 1e5;
constexpr double k_infinite = std::numeric_limits<double>::infinity();

}  // namespace

ConvexBody::ConvexBody(const Solid& solid) : ground_(ground_facets(solid)) {
    for (const Facet& facet : solid.facets) {
        normals_.push_back(facet.plane.normal);
        nx_.push_back(facet.plane.normal.x);
        ny_.push_back(facet.plane.normal.y);
        nz_.push_back(facet.plane.normal.z);
        offset_.push_back(facet.plane.offset);
    }
    find_near_planes(solid);
}

// A square in the facet's plane, clipped by all other planes. Empty if the facet is redundant.
std::vector<Vec3> ConvexBody::outline(int facet, const Vec3& middle, double reach) const {
    const Vec3& n = normal(facet);
    const Vec3 u = perpendicular_to(n), v = glm::cross(n, u);
    std::vector<Vec3> loop, cut;
    for (const auto& [a, b] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
        loop.push_back(on_facet(facet, middle + 2 * reach * (a * u + b * v)));
    double radius = 4 * reach;
    for (std::size_t k = 0; k < offset_.size() && !loop.empty(); ++k) {
        if (static_cast<int>(k) == facet) continue;
        const auto above = [&](const Vec3& p) { return glm::dot(normals_[k], p) - offset_[k]; };
        if (above(loop[0]) < -2 * radius) continue;
        cut.clear();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 &from = loop[i], &to = loop[(i + 1) % loop.size()];
            const double h0 = above(from), h1 = above(to);
            if (h0 <= 0) cut.push_back(from);
            if ((h0 < 0 && h1 > 0) || (h0 > 0 && h1 < 0))
                cut.push_back(from + h0 / (h0 - h1) * (to - from));
        }
        loop.swap(cut);
        radius = 0;
        for (const Vec3& p : loop) radius = std::max(radius, glm::length(p - loop[0]));
        radius *= 1.000001;
    }
    return loop;
}

void ConvexBody::find_near_planes(const Solid& solid) {
    near_begin_.assign(offset_.size() + 1, 0);
    const double reach = 2 * diameter(solid);
    if (!(reach > 0)) return;
    double outermost = 0;
    Vec3 low = solid.vertices[0], high = low;
    for (const Vec3& p : solid.vertices) {
        outermost = std::max(outermost, glm::length(p));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double size = reach + outermost;
    margin_ = k_margin * size;
    far_ = k_far * size;
    const Vec3 middle = 0.5 * (low + high);
    for (std::size_t f = 0; f < offset_.size(); ++f) {
        near_begin_[f] = near_.size();
        const std::vector<Vec3> loop = outline(static_cast<int>(f), middle, reach);
        const bool whole = std::all_of(loop.begin(), loop.end(), [&](const Vec3& p) {
            return glm::length(p - middle) < reach;
        });
        std::size_t count = 0;
        const auto add = [&](const Vec3& n, double offset, int facet) {
            const std::size_t i = count++ % 4;
            if (i == 0) {
                near_.emplace_back();
                near_.back().offset.fill(Two{} + k_infinite);
                near_.back().facet.fill(static_cast<int>(f));
            }
            NearPlanes& four = near_.back();
            four.nx[i / 2][i % 2] = n.x;
            four.ny[i / 2][i % 2] = n.y;
            four.nz[i / 2][i % 2] = n.z;
            four.offset[i / 2][i % 2] = offset;
            four.facet[i] = facet;
        };
        if (loop.empty() || !whole) {
            // Never confirmed as a guess.
            add({0, 0, 0}, -k_infinite, static_cast<int>(f));
            continue;
        }
        double around = 0;
        for (const Vec3& p : loop) around = std::max(around, glm::length(p - loop[0]));
        for (std::size_t k = 0; k < offset_.size(); ++k) {
            if (k == f || glm::dot(normals_[k], loop[0]) - offset_[k] < -1.1 * around - 2 * margin_)
                continue;
            double highest = -k_infinite;
            for (const Vec3& p : loop)
                highest = std::max(highest, glm::dot(normals_[k], p) - offset_[k]);
            if (highest > -2 * margin_) add(normals_[k], offset_[k], static_cast<int>(k));
        }
    }
    near_begin_.back() = near_.size();
}

bool ConvexBody::surely_on_facet(int facet, const Vec3& point) const {
    const std::size_t f = static_cast<std::size_t>(facet);
    Two least0 = Two{} + k_infinite, least1 = least0;
    for (std::size_t b = near_begin_[f]; b < near_begin_[f + 1]; ++b) {
        const Two below0 = near_[b].below(0, point), below1 = near_[b].below(1, point);
        least0 = below0 < least0 ? below0 : least0;
        least1 = below1 < least1 ? below1 : least1;
    }
    least0 = least1 < least0 ? least1 : least0;
    return std::min(least0[0], least0[1]) > margin_;
}

// The first hit of a ray among a facet and the planes near it.
int ConvexBody::nearest_about(int facet, const Vec3& origin, const Vec3& direction) const {
    const std::size_t f = static_cast<std::size_t>(facet);
    int nearest = facet;
    double best = k_infinite;
    const double towards_own = glm::dot(normals_[f], direction);
    if (towards_own > 0) best = (offset_[f] - glm::dot(normals_[f], origin)) / towards_own;
    for (std::size_t b = near_begin_[f]; b < near_begin_[f + 1]; ++b) {
        const NearPlanes& four = near_[b];
        for (std::size_t pair = 0; pair < 2; ++pair) {
            const Two towards = four.towards(pair, direction), below = four.below(pair, origin);
            for (std::size_t i = 0; i < 2; ++i) {
                if (towards[i] > 0 && below[i] < best * towards[i]) {
                    best = below[i] / towards[i];
                    nearest = four.facet[2 * pair + i];
                }
            }
        }
    }
    return nearest;
}

// For `size` planes from `start`: how fast a ray runs towards each, and how far below it the ray
// starts.
void ConvexBody::measure(std::size_t start, std::size_t size, const Vec3& origin,
                         const Vec3& direction, double* towards, double* below) const {
    const double *nx = nx_.data() + start, *ny = ny_.data() + start, *nz = nz_.data() + start,
                 *offset = offset_.data() + start;
    for (std::size_t i = 0; i < size; ++i) {
        towards[i] = nx[i] * direction.x + ny[i] * direction.y + nz[i] * direction.z;
        below[i] = offset[i] - (nx[i] * origin.x + ny[i] * origin.y + nz[i] * origin.z);
    }
}

std::optional<BodyHit> ConvexBody::entry(const Vec3& origin, const Vec3& direction) const {
    EntryGuess none;
    return entry(origin, direction, none);
}

std::optional<BodyHit> ConvexBody::entry(const Vec3& origin, const Vec3& direction,
                                         EntryGuess& last) const {
    const auto towards = [&](int facet) { return glm::dot(normal(facet), direction); };
    const auto below = [&](int facet) {
        return offset_[static_cast<std::size_t>(facet)] - glm::dot(normal(facet), origin);
    };
    if (last.facet >= 0) {
        const double t = towards(last.facet), b = below(last.facet);
        if (t < 0 && b < 0 && b / t < far_ &&
            surely_on_facet(last.facet, origin + b / t * direction))
            return BodyHit{last.facet, b / t};
    }
    if (last.left >= 0) {
        const double out = towards(last.left), in = towards(last.entered);
        if (out > 0 && in < 0 && !(below(last.entered) / in < below(last.left) / out))
            return std::nullopt;
    }
    BodyHit hit;
    int left = -1;
    double enter = -k_infinite, leave = k_infinite;
    const std::size_t count = offset_.size();
    for (std::size_t start = 0; start < count; start += k_block) {
        double t[k_block], b[k_block], distance[k_block];
        const std::size_t size = std::min(k_block, count - start);
        measure(start, size, origin, direction, t, b);
        // The distance of a ray along a plane is not used; avoid 0/0.
        for (std::size_t i = 0; i < size; ++i) distance[i] = b[i] / (t[i] == 0 ? 1 : t[i]);
        for (std::size_t i = 0; i < size; ++i) {
            if (t[i] < 0) {
                if (distance[i] > enter) {
                    enter = distance[i];
                    hit.facet = static_cast<int>(start + i);
                }
            } else if (t[i] > 0) {
                if (distance[i] < leave) {
                    leave = distance[i];
                    left = static_cast<int>(start + i);
                }
            } else if (b[i] < 0) {
                return std::nullopt;
            }
        }
        if (!(enter < leave)) {
            last.left = left;
            last.entered = hit.facet;
            return std::nullopt;
        }
    }
    if (hit.facet < 0 || enter < 0) return std::nullopt;
    hit.distance = enter;
    last.facet = hit.facet;
    return hit;
}

BodyHit ConvexBody::exit(const Vec3& origin, const Vec3& direction, int guess) const {
    // Walk from facet to facet towards the nearest; if that takes too long, search all.
    constexpr int k_most_steps = 8;
    for (int step = 0; guess >= 0 && step < k_most_steps; ++step) {
        const std::size_t f = static_cast<std::size_t>(guess);
        const double towards = glm::dot(normals_[f], direction);
        if (towards > 0) {
            const double below = offset_[f] - glm::dot(normals_[f], origin);
            const double distance = std::max(below, 0.0) / towards;
            if (distance < far_ && surely_on_facet(guess, origin + distance * direction))
                return {guess, distance};
        }
        const int next = nearest_about(guess, origin, direction);
        if (next == guess) break;
        guess = next;
    }
    return exit_of_all(origin, direction);
}

BodyHit ConvexBody::exit_of_all(const Vec3& origin, const Vec3& direction) const {
    // The nearest plane has the largest towards/below. Both are positive for the planes that count.
    BodyHit hit;
    double best = k_infinite;
    const std::size_t count = offset_.size();
    for (std::size_t start = 0; start < count; start += k_block) {
        double towards[k_block], below[k_block];
        const std::size_t size = std::min(k_block, count - start);
        measure(start, size, origin, direction, towards, below);
        for (std::size_t i = 0; i < size; ++i) {
            if (towards[i] > 0 && below[i] < best * towards[i]) {
                best = std::max(below[i], 0.0) / towards[i];
                hit.facet = static_cast<int>(start + i);
            }
        }
    }
    check(hit.facet >= 0, "a ray inside the stone met no facet");
    hit.distance = best;
    return hit;
}

bool ConvexBody::contains(const Vec3& point) const {
    for (std::size_t f = 0; f < offset_.size(); ++f) {
        if (glm::dot(normals_[f], point) >= offset_[f]) return false;
    }
    return true;
}

}  // namespace culet
