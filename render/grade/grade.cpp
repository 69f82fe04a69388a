#include "render/grade/grade.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>

#include "render/work/threads.h"
#include "stone/design/tiers.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// After so many faces less than a thousandth of the light remains; the balance reports it
// (residual).
constexpr int k_balance_faces = 20, k_fire_faces = 10;
constexpr int k_balance_rings = 2, k_fire_rings = 1;
constexpr int k_dome_rings = 4, k_coarse_dome_rings = 2;
constexpr int k_ring = 8, k_coarse_ring = 2, k_coarse_map = 300, k_coarse_fire_faces = 8;
// Relative; planes that miss their meets by 3e-4 of the width change the volume by no more.
constexpr double k_same_volume = 5e-3;
// Level facets, as in GemRay's `facettype`.
constexpr double k_level = 1e-4;

double mean_index(const Material& material, double nm) {
    double sum = 0;
    const int rays = ray_count(material.optic);
    for (int ray = 0; ray < rays; ++ray)
        sum += material.index[static_cast<std::size_t>(ray)].at(nm);
    // In a uniaxial crystal two of three principal rays are ordinary.
    if (rays == 2) return (sum + material.index[0].at(nm)) / 3;
    return sum / rays;
}

// True for a convex stone: no corner is above a plane, and it fills the planes' body, within the
// misses of real designs' meets.
bool is_what_its_planes_bound(const Solid& solid) {
    const double miss = k_largest_miss * diameter(solid);
    for (const Facet& facet : solid.facets) {
        for (const Vec3& corner : solid.vertices) {
            if (height_above(facet.plane, corner) > miss) return false;
        }
    }
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets) planes.push_back({facet.name, facet.plane});
    const HalfSpaceSolid bound = intersect_half_spaces(planes);
    if (!bound.bounded || bound.empty) return false;
    return std::abs(volume(bound.solid) / volume(solid) - 1) < k_same_volume;
}

void require_gradable(const Solid& solid, const GradeIndex& index) {
    if (!(index.n > 1) || !std::isfinite(index.n)) {
        throw InputError(fmt::format("a stone's refractive index is above 1, found {:g}", index.n));
    }
    // Beams use planes only, so outlines may cross themselves by the rounding of near meets.
    const std::vector<Fault> faults =
        find_faults(solid, {.planarity = k_largest_miss, .must_be_convex = false});
    for (const Fault& fault : faults) {
        if (fault.kind == FaultKind::self_crossing || fault.kind == FaultKind::degenerate_facet ||
            fault.kind == FaultKind::unused_vertex || fault.kind == FaultKind::repeated_name)
            continue;
        throw InputError(fmt::format("cannot be graded: {}: {} (culet info lists all faults)",
                                     name_of(fault.kind), fault.what));
    }
    if (!is_what_its_planes_bound(solid)) {
        throw InputError(
            "is not convex: only stones whose light leaves for good can be graded "
            "(culet render draws this one)");
    }
}

LightBalance& operator+=(LightBalance& sum, const LightBalance& b) {
    sum.useful += b.useful;
    sum.head += b.head;
    sum.other += b.other;
    sum.leak += b.leak;
    sum.entry_reflection += b.entry_reflection;
    sum.residual += b.residual;
    return sum;
}

LightBalance operator*(double factor, LightBalance b) {
    for (double* part : {&b.useful, &b.head, &b.other, &b.leak, &b.entry_reflection, &b.residual})
        *part *= factor;
    return b;
}

// Reports progress from all threads, and asks whether to go on.
class Asking {
public:
    explicit Asking(const Progress& progress) : progress_(progress) {}
    void expect(std::size_t jobs) { jobs_ = jobs; }
    void job_done() { ++done_; }
    bool goes_on() {
        if (!progress_) return true;
        const std::scoped_lock lock(telling_);
        stopped_ = stopped_ || !progress_(static_cast<double>(done_) / static_cast<double>(jobs_));
        return !stopped_;
    }

private:
    const Progress& progress_;
    std::size_t jobs_ = 1;
    std::atomic<std::size_t> done_{0};
    bool stopped_ = false;
    std::mutex telling_;
};

// Independent parts of the work.
struct Work {
    const Solid& solid;
    const GradeOptions& options;
    EyeLightTracer tracer;
    std::vector<bool> crown;
    Grade& grade;

    Work(const Solid& s, const GradeOptions& o, Grade& g, Asking& asking)
        : solid(s),
          options(o),
          tracer(s, [&asking] { return asking.goes_on(); }),
          crown(crown_facets(s)),
          grade(g) {}

    int map_size() const { return options.coarse ? k_coarse_map : options.map_size; }

    void face_up(const RandomSky& sky) {
        const double n = grade.index.n;
        const EyeLight light = tracer.trace({0, 0, 1}, n, {.regions = true});
        grade.silhouette_area = light.area;
        grade.face_up = light_return(light, grade.table, options.head, sky);
        grade.aset = aset_shares(light);
        if (grade.table >= 0) {
            grade.aset_table = aset_shares(light, grade.table);
            grade.table_reflection = table_reflection(light, grade.table);
        }
        grade.ideal_scope = ideal_scope_shares(light);
        grade.dark_field = dark_field_share(light);
        const double open = light_return(light, -1, 0, sky).whole[0];
        grade.head_shadow = open > 0 ? 1 - grade.face_up.whole[0] / open : 0;
        grade.arrows = find_arrows(scope_map(light, reflector_bands(), map_size()));
    }
    void from_below() {
        const EyeLight light = tracer.trace({0, 0, -1}, grade.index.n, {.regions = true});
        grade.hearts = find_hearts(scope_map(light, reflector_bands(true), map_size()));
    }
    // Weighted with the horizontal area that light along the direction falls on.
    struct Cone {
        LightBalance balance;
        double area = 0;
    };
    Cone balance_along(const Vec3& direction) const {
        EyeLight light = tracer.trace(direction, grade.index.n,
                                      {.faces = options.coarse ? k_fire_faces : k_balance_faces});
        light.towards_eye = {0, 0, 1};
        const double area = light.area / direction.z;
        return {area * light_balance(light, crown, {options.head, options.view_cone}), area};
    }
    struct FireAlong {
        Fire fire;
        double area = 0;
    };
    FireAlong fire_along(const Vec3& direction) const {
        std::array<EyeLight, 3> colours;
        for (std::size_t i = 0; i < 3; ++i) {
            colours[i] = tracer.trace(
                direction, (*grade.index.fire)[i],
                {.faces = options.coarse ? k_coarse_fire_faces : k_fire_faces, .regions = true});
        }
        const double area = colours[0].area / direction.z;
        return {fire_of(colours, crown, {0, 0, 1}, options.view_cone), area};
    }
};

// Runs jobs on all threads, in any order.
void run_all(const std::vector<std::function<void()>>& jobs, Asking& asking) {
    asking.expect(jobs.size());
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
        if (!asking.goes_on()) return;
        jobs[i]();
        asking.job_done();
    });
    if (!asking.goes_on()) throw Interrupted();
}

}  // namespace

GradeIndex grade_index(const Material* material, std::optional<double> n) {
    check(material != nullptr || n.has_value(), "a material or an index");
    GradeIndex index;
    if (material == nullptr) {
        index.n = *n;
        return index;
    }
    const double own = mean_index(*material, k_grade_nm);
    index.n = n.value_or(own);
    std::array<double, 3> fire{};
    for (std::size_t i = 0; i < fire.size(); ++i)
        fire[i] = mean_index(*material, k_fire_nm[i]) + (index.n - own);
    if (fire[0] > fire[2] && fire[2] > 1) index.fire = fire;
    return index;
}

Vec3 eye_over_tilted(double tilt, double axis) {
    return {std::sin(axis) * std::sin(tilt), -std::cos(axis) * std::sin(tilt), std::cos(tilt)};
}

std::vector<Vec3> cone_directions(double half_angle, int rings, int each) {
    std::vector<Vec3> directions;
    for (int ring = 0; ring < rings; ++ring) {
        // Rings of equal area in the disc of sines, each at its root-mean-square radius.
        const double sine = std::sin(half_angle) * std::sqrt((ring + 0.5) / rings);
        for (int k = 0; k < each; ++k) {
            const double azimuth = 2 * std::numbers::pi * (k + 0.25 + 0.5 * (ring % 2)) / each;
            directions.push_back(
                {sine * std::cos(azimuth), sine * std::sin(azimuth), std::sqrt(1 - sine * sine)});
        }
    }
    return directions;
}

std::vector<Vec3> hemisphere_directions(int rings, int each) {
    std::vector<Vec3> directions;
    for (int ring = 0; ring < rings; ++ring) {
        const double height = (ring + 0.5) / rings, level = std::sqrt(1 - height * height);
        for (int k = 0; k < each; ++k) {
            const double azimuth = 2 * std::numbers::pi * (k + 0.25 + 0.5 * (ring % 2)) / each;
            directions.push_back({level * std::cos(azimuth), level * std::sin(azimuth), height});
        }
    }
    return directions;
}

std::vector<bool> crown_facets(const Solid& solid) {
    std::vector<bool> crown;
    for (const Facet& facet : solid.facets) crown.push_back(facet.plane.normal.z > k_level);
    return crown;
}

Grade grade_stone(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                  const Progress& progress) {
    require_gradable(solid, index);
    return grade_convex(solid, index, options, progress);
}

Grade grade_convex(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                   const Progress& progress) {
    Grade grade;
    grade.index = index;
    grade.table = table_facet(solid, {0, 0, 1});
    grade.tilts = options.tilts;
    Asking asking(progress);
    Work work(solid, options, grade, asking);
    const RandomSky sky(options.seed, index.n);
    std::vector<std::function<void()>> jobs{[&] { work.face_up(sky); }, [&] { work.from_below(); }};
    for (const double axis : options.tilt_axes)
        grade.curves.push_back({axis, std::vector<ViewReturn>(options.tilts.size())});
    for (TiltCurve& curve : grade.curves) {
        for (std::size_t i = 0; i < options.tilts.size(); ++i) {
            jobs.emplace_back([&, i, at = &curve] {
                const EyeLight light =
                    work.tracer.trace(eye_over_tilted(options.tilts[i], at->axis), index.n);
                at->returns[i] = light_return(light, grade.table, options.head, sky);
            });
        }
    }
    const std::vector<Vec3> around =
        cone_directions(options.light_cone, options.coarse ? 1 : k_balance_rings, k_ring);
    std::vector<Work::Cone> balances(around.size());
    for (std::size_t i = 0; i < around.size(); ++i)
        jobs.emplace_back([&, i] { balances[i] = work.balance_along(around[i]); });
    const std::vector<Vec3> dome =
        hemisphere_directions(options.coarse ? k_coarse_dome_rings : k_dome_rings, k_ring);
    std::vector<WeightedReturn> returned(dome.size());
    for (std::size_t i = 0; i < dome.size(); ++i) {
        jobs.emplace_back(
            [&, i] { returned[i] = weighted_return(work.tracer.trace(dome[i], index.n)); });
    }
    const std::vector<Vec3> coloured =
        cone_directions(options.light_cone, k_fire_rings, options.coarse ? k_coarse_ring : k_ring);
    std::vector<Work::FireAlong> fires(index.fire ? coloured.size() : 0);
    for (std::size_t i = 0; i < fires.size(); ++i)
        jobs.emplace_back([&, i] { fires[i] = work.fire_along(coloured[i]); });
    on_threads(options.threads, [&] { run_all(jobs, asking); });

    double area = 0;
    for (const Work::Cone& cone : balances) area += cone.area;
    for (const Work::Cone& cone : balances) grade.balance += (1 / area) * cone.balance;
    WeightedReturn weighted;
    for (const WeightedReturn& part : returned) {
        weighted.returned += part.returned;
        weighted.weight += part.weight;
    }
    grade.weighted_return = weighted.returned / weighted.weight;
    if (!fires.empty()) {
        grade.fire.emplace();
        double fire_area = 0;
        for (const Work::FireAlong& one : fires) fire_area += one.area;
        for (const Work::FireAlong& one : fires) grade.fire->add(one.fire, one.area / fire_area);
    }
    return grade;
}

}  // namespace culet
