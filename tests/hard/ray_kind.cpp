// Cases of kind "ray": the whole tree of light paths behind eye rays. Expectations: energy balance,
// and invariance under turning, scaling and reordering.
//
// [ray]: aim = vertex | edge | facet | facet_plane | down | random | edge_line | leaves_by_vertex |
// leaves_by_edge; `miss`: beside it by so many diameters (facet_plane, edge_line: out of the plane
// or line by so many radians; down: off the vertical by so many). edge_line: along an edge, from a
// point of its line. leaves_by_...: the ray refracted at the first facet goes there. `from`:
// distance of the eye in diameters (5). draws, seed.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "render/reference/probe.h"
#include "stone/text/errors.h"
#include "tests/hard/hard_scenes.h"
#include "tests/random_attitudes.h"

namespace culet::hard {

namespace {

struct RayCase {
    Scene scene;
    std::vector<EyeRay> rays;
    double size = 1;
};

// An eye ray whose refracted ray runs from the inside of a facet to a point of the surface.
std::optional<EyeRay> through_to(const Vec3& goal, const Solid& solid, double n, double from,
                                 RandomAttitudes& random) {
    for (int attempt = 0; attempt < 400; ++attempt) {
        const Facet& facet =
            solid.facets[std::size_t(random.one_of(static_cast<int>(solid.facets.size())))];
        const Vec3& out = facet.plane.normal;
        const Vec3 across = random.across(out, 1);
        const double lean = random.between(0.05, 1.3), sine = std::sin(lean) / n;
        const Vec3 inside = sine * across - std::sqrt(1 - sine * sine) * out;
        const double steep = glm::dot(inside, out);
        const Vec3 at = goal + (height_above(facet.plane, goal) / -steep) * inside;
        bool on_facet = height_above(facet.plane, goal) < -1e-3 * diameter(solid);
        for (const Facet& other : solid.facets) {
            on_facet &= &other == &facet || height_above(other.plane, at) < -1e-6 * diameter(solid);
        }
        if (!on_facet) continue;
        const Vec3 direction = std::sin(lean) * across - std::cos(lean) * out;
        return EyeRay{at - from * direction, direction};
    }
    return std::nullopt;
}

std::vector<EyeRay> make_rays(const TomlTable& t, const Solid& solid, double n) {
    t.refuse_unknown({"aim", "miss", "from", "draws", "seed"});
    const std::string aim = t.text("aim").value_or("random");
    RandomAttitudes random(static_cast<unsigned>(t.integer("seed").value_or(1)));
    const double size = diameter(solid), miss = t.number("miss").value_or(0),
                 from = size * t.number("from").value_or(5);
    const Vec3 middle = centroid(solid);
    std::vector<EyeRay> rays;
    for (int draw = 0; draw < t.integer("draws").value_or(10); ++draw) {
        const Facet& facet =
            solid.facets[std::size_t(random.one_of(static_cast<int>(solid.facets.size())))];
        const int count = static_cast<int>(facet.corners.size()), k = random.one_of(count);
        const Vec3 &a = solid.vertices[std::size_t(facet.corners[std::size_t(k)])],
                   &b = solid.vertices[std::size_t(facet.corners[std::size_t((k + 1) % count)])];
        Vec3 target = corner_mean(solid, facet), eye;
        if (aim == "leaves_by_vertex" || aim == "leaves_by_edge") {
            const Vec3 goal = aim == "leaves_by_edge" ? a + random.between(0.1, 0.9) * (b - a) : a;
            const auto ray =
                through_to(goal + miss * size * random.direction(), solid, n, from, random);
            if (ray) rays.push_back(*ray);
            continue;
        }
        if (aim == "edge_line") {
            if (a == b) continue;  // an edge too short for its coordinates has no line
            const Vec3 along = glm::normalize(b - a);
            const Vec3 lean = std::cos(miss) * along + std::sin(miss) * random.across(along, 1);
            rays.push_back({0.5 * (a + b) - from * lean, lean});
            continue;
        }
        if (aim == "vertex") target = a;
        if (aim == "edge") target = a + random.between(0.1, 0.9) * (b - a);
        if (aim == "random") target += 0.2 * (a - target);
        // From outside the facet, at up to 60 degrees to its normal.
        const Vec3 across = random.across(facet.plane.normal, 1);
        const double lean = random.between(0.02, 1);
        eye = target + from * (std::cos(lean) * facet.plane.normal + std::sin(lean) * across);
        if (aim == "facet_plane") {
            eye = target + from * (std::cos(miss) * across + std::sin(miss) * facet.plane.normal);
        } else if (aim == "down") {
            const Vec3 up{std::sin(miss), 0, std::cos(miss)};
            target = middle + 0.2 * size * random.between(-1, 1) * Vec3{1, 0, 0} +
                     0.2 * size * random.between(-1, 1) * Vec3{0, 1, 0};
            eye = target + from * up;
        } else {
            target += miss * size * random.direction();
        }
        if (aim != "vertex" && aim != "edge" && aim != "facet" && aim != "facet_plane" &&
            aim != "down" && aim != "random") {
            t.fail("aim", "is no aim of rays");
        }
        rays.push_back({eye, glm::normalize(target - eye)});
    }
    return rays;
}

double imbalance(const ProbeResult& result) {
    if (!result.hit) return 0;
    double worst = 0;
    for (std::size_t k = 0; k < result.radiance.size(); ++k) {
        double sum = result.remainder[k] + result.absorbed[k] + result.cut[k] - 1;
        for (const ProbedPath& path : result.paths) sum += path.weight[k];
        worst = std::isfinite(sum) ? std::max(worst, std::abs(sum)) : 1e300;
    }
    return worst;
}

template <class Each>
Measured worst_ray(const RayCase& c, Each each) {
    Measured worst;
    for (std::size_t i = 0; i < c.rays.size(); ++i) {
        const double error = each(c.rays[i], static_cast<unsigned>(i));
        if (!(error <= worst.error)) {
            const EyeRay& r = c.rays[i];
            worst = {
                error, worst.condition,
                fmt::format("--ray {:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}", r.origin.x,
                            r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z)};
        }
    }
    return worst;
}

double radiance(const Scene& scene, const EyeRay& ray) {
    return probe(scene, ray).radiance[0];
}

double apart(double a, double b) {
    return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-300});
}

}  // namespace

Subject ray_subject(const HardCase& hard_case, const HardPoint& point,
                    const TomlTable& parameters) {
    const auto c = std::make_shared<RayCase>();
    c->scene = hard_scene(hard_case, point, parameters);
    c->size = diameter(c->scene.stone.solid);
    c->rays = make_rays(parameters.table("ray").value(), c->scene.stone.solid,
                        c->scene.stone.material.index[0].at(589.3));
    // Rays have their own eyes; the camera only has to be somewhere outside.
    c->scene.camera.look_at = centroid(c->scene.stone.solid);
    c->scene.camera.position = c->scene.camera.look_at + 40 * c->size * Vec3{0, 0, 1};
    Subject subject;
    auto& is = subject.invariants;
    is["energy"] = [c] {
        return worst_ray(
            *c, [&](const EyeRay& ray, unsigned) { return imbalance(probe(c->scene, ray)); });
    };
    is["finite"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned) {
            const ProbeResult result = probe(c->scene, ray);
            double bad = 0;
            for (const double r : result.radiance) bad += !std::isfinite(r) || r < 0;
            for (const ProbedPath& p : result.paths) {
                bad += !std::isfinite(p.exit_direction.x + p.stokes[0] + p.stokes[1]);
                bad += std::abs(glm::length(p.exit_direction) - 1) > 1e-14;
                for (const double w : p.weight) bad += !(w >= 0);
            }
            return bad;
        });
    };
    is["faces"] = [c] {
        return worst_ray(
            *c, [&](const EyeRay& ray, unsigned) { return probe(c->scene, ray).worst_imbalance; });
    };
    is["refused"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned) {
            try {
                probe(c->scene, ray);
            } catch (const InputError&) {
                return 0.0;
            }
            return 1.0;
        });
    };
    // On an edge either neighbour may answer, but nothing else.
    is["one_of_its_neighbours"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned i) {
            const double here = radiance(c->scene, ray);
            RandomAttitudes random(i);
            double nearest = 1e300;
            for (int k = 0; k < 24 && nearest > 1e-12; ++k) {
                EyeRay beside = ray;
                beside.origin += 1e-9 * c->size * random.across(ray.direction, 1);
                nearest = std::min(nearest, apart(here, radiance(c->scene, beside)));
            }
            return nearest;
        });
    };
    is["turned"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned i) {
            const Turn turn = random_turn(i);
            return apart(radiance(c->scene, ray),
                         radiance(turned(c->scene, turn),
                                  {turn(ray.origin), glm::normalize(turn(ray.direction))}));
        });
    };
    is["reordered"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned i) {
            return apart(radiance(c->scene, ray), radiance(reordered(c->scene, i), ray));
        });
    };
    is["binary_units"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned) {
            return apart(radiance(c->scene, ray), radiance(scaled(c->scene, 0x1p-30),
                                                           {0x1p-30 * ray.origin, ray.direction}));
        });
    };
    is["units"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned i) {
            const double factor = i % 2 == 0 ? 1e-6 : 1e6;
            return apart(radiance(c->scene, ray),
                         radiance(scaled(c->scene, factor), {factor * ray.origin, ray.direction}));
        });
    };
    is["last_digit"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned i) {
            unsigned state = i;
            EyeRay beside{nudged(ray.origin, state), nudged(ray.direction, state)};
            return apart(radiance(c->scene, ray), radiance(nudged(c->scene, i), beside));
        });
    };
    is["shaken_by_1e-12"] = [c] {
        return worst_ray(*c, [&](const EyeRay& ray, unsigned i) {
            RandomAttitudes random(i);
            const EyeRay beside{ray.origin + 1e-12 * c->size * random.direction(),
                                glm::normalize(ray.direction + 1e-12 * random.direction())};
            return apart(radiance(c->scene, ray), radiance(c->scene, beside));
        });
    };
    // The same stone as glass of the mean index: where the principal indices are equal, so must the
    // pictures be.
    is["isotropic_limit"] = [c] {
        Scene glass = c->scene;
        Material& m = glass.stone.material;
        const int rays = ray_count(m.optic);
        double mean = 0;
        for (int k = 0; k < rays; ++k) mean += m.index[std::size_t(k)].at(589.3) / rays;
        m.optic = OpticCharacter::isotropic;
        m.index[0] = {};
        m.index[0].n = mean;
        return worst_ray(*c, [&](const EyeRay& ray, unsigned) {
            return apart(radiance(c->scene, ray), radiance(glass, ray));
        });
    };
    return subject;
}

}  // namespace culet::hard
