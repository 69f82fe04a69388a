#pragma once
// The equations of one fit: which readings, meets and relations bind which unknowns.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/model/known_planes.h"
#include "fit/model/options.h"
#include "fit/model/parameters.h"
#include "fit/model/prior.h"
#include "fit/model/residuals.h"
#include "fit/readings/measurement.h"
#include "fit/readings/replicates.h"
#include "stone/half_edges.h"

namespace culet {

/// formula = value, within sigma or exactly. In the scale of the fit (half diameter 1).
struct Equation {
    enum class Role {
        reading,
        relation,     ///< of symmetry, parallel and coplanar readings
        incidence,    ///< a plane passes through a meet
        released,     ///< likewise, held only so far that the meet has a place at all
        expected,     ///< the prior of the facets (prior.h)
        known_planes  ///< what outlines or a photograph tell of the planes
    };
    Role role = Role::reading;
    int reading = -1;  ///< index, or -1
    int incidence = -1;
    int group = -1;  ///< of estimated uncertainty, or -1
    bool exact = false;
    double value = 0, sigma = 1;
    double size = 1;  ///< of the quantity, by which early stages soften it
    /// What the reading may as well mean: of a nearly upright facet an inclination does not say
    /// whether it leans in or out.
    std::optional<double> other_value;
    /// A length |x|, with a kink at zero that an early stage rounds off.
    bool has_kink = false;
    /// Of a caliper: the corners that its jaws touch, the upper one first, along this direction.
    std::array<Corner, 2> touched{};
    Vec3 caliper{0, 0, 0};
    /// Of readings of one quantity, which share this equation: its value is their mean.
    std::vector<Replicate> replicates;
    double scatter = 0;  ///< about the mean, in sigmas squared
    Formula formula;

    int readings() const { return replicates.empty() ? 1 : static_cast<int>(replicates.size()); }
    /// Takes part in chi-square and in the count of redundancy.
    bool is_counted() const { return !exact && role != Role::released; }
};

struct Incidence {
    int point = -1, facet = -1;
    MeetTreatment how = MeetTreatment::exact;
    double sigma = 0;  ///< soft; 0: the common one
    int reading = -1;  ///< that asks for it
};

class System {
public:
    /// Brings the mesh upright, to half diameter 1 and, when lengths were read, to their scale;
    /// with azimuths of free zero it is turned until they fit best.
    System(const Stone& stone, const std::vector<Reading>& readings, const FitOptions& options);

    const Stone& stone() const { return stone_; }
    const std::vector<Reading>& readings() const { return readings_; }
    const std::vector<Incidence>& incidences() const { return incidences_; }
    /// The mesh as it starts.
    const Shape& mesh_shape() const { return mesh_shape_; }
    /// Those that the jaws of a width, a depth or a table's width may touch.
    std::vector<Corner> corners_between_jaws(const Reading& reading, const Outline& outline) const;
    const std::shared_ptr<const Outline>& mesh_outline() const { return mesh_outline_; }
    const HalfEdges& edges() const { return edges_; }
    Layout layout() const { return layout_of(mesh_shape_); }
    int up_facet() const { return up_facet_; }
    /// Some meet may come apart: the stone is what its planes enclose.
    bool splits() const { return splits_; }
    bool has_common_meets() const;

    /// Of the mesh, the widest in plan, in the scale of the fit.
    double half_width() const;
    /// How soft meets miss, where no uncertainty is given: group 0 by polished facets, group 1 by
    /// girdle facets (the girdle is shaped before the facets and by other means).
    const std::array<double, 2>& group_sigmas() const { return group_sigmas_; }
    void set_group_sigma(int group, double sigma) { group_sigmas_[std::size_t(group)] = sigma; }
    bool has_estimated_groups() const;
    bool has_prior() const { return !prior_.empty(); }
    bool has_outlines() const { return has_outlines_; }
    /// Outlines or photographs.
    bool has_known_planes() const { return !known_planes_.empty(); }
    const PriorSigmas& prior_sigmas() const { return prior_.sigmas; }
    /// Of a reading from now on, in its unit (robust weights).
    void set_reading_sigma(int reading, double sigma) {
        readings_[std::size_t(reading)].sigma = sigma;
    }

    /// From now on every reading has an equation of its own.
    void keep_replicates_apart() { replicated_.clear(); }
    bool has_replicates() const { return !replicated_.empty(); }

    /// All equations but hinges, for the corners that carry them at this shape.
    std::vector<Equation> equations(const Shape& shape,
                                    const std::shared_ptr<const Outline>& outline) const;
    /// Of these, what the readings say; `reduced`: but for symmetry that `parameters` takes care
    /// of. `meets_hold`: corners lie on their planes, so that the line in which two planes cross is
    /// the edge, with its direction. On a rough shape that line says nothing.
    std::vector<Equation> reading_equations(const Shape& shape,
                                            const std::shared_ptr<const Outline>& outline,
                                            bool reduced = false, bool meets_hold = true) const;
    /// By how much a plane may pass its meet: 0 when exact.
    double incidence_sigma(const Incidence& incidence) const;
    /// The motions of exact rotations and mirrors of the whole stone. Empty when a reading would
    /// see how they are turned about the axis (a mirror of facets in pairs, beside azimuths), or
    /// when some meet is not exact.
    const std::vector<SymmetryMotion>& exact_motions() const { return exact_motions_; }
    /// What the solver varies.
    Parameters parameters() const;

    /// Facets, and the corners of their neighbours, which stay below them: in order. None of a
    /// stone that need not be convex.
    std::vector<std::pair<int, int>> hinges() const;
    /// What the planes of the shape enclose. `enclosed` is the solid itself; false in `whole` when
    /// a facet is missing or the planes do not close.
    struct Enclosed {
        Solid solid;
        std::shared_ptr<const Outline> outline;
        bool closed = false;
        std::vector<std::string> missing;
    };
    Enclosed enclosed(const Shape& shape) const;
    /// The solid of the mesh's own facets and the shape's points.
    Solid met_solid(const Shape& shape) const;

    /// By how much the mesh was made larger to suit the lengths read.
    double mesh_scale() const { return mesh_scale_; }
    /// By how much it was turned about up, to stand as the azimuths read say.
    double mesh_turn() const { return turn_; }
    /// Length of the stone's unit that is 1 inside.
    double scale() const { return scale_; }
    /// Within 10 degrees of upright in the mesh.
    bool is_girdle(int facet) const;
    /// What a quantity of a reading is multiplied by to be in the reading's unit.
    double unit_of(const Reading& reading) const;
    /// Turns inside positions back into the stone's unit and the mesh's pose; the rest of the
    /// motion (a free azimuth, a drift) is chosen so that the points lie nearest to the mesh's.
    struct Pose {
        double turn = 0;  ///< about up, from inside to outside
        Vec3 shift{0, 0, 0};
    };
    Pose pose_of(const Shape& shape) const;
    /// The pose's turn, with its derivatives by the points; none when azimuths count from the mesh.
    Quantity turn_of(const Shape& shape) const;
    Vec3 outside_point(const Vec3& p, const Pose& pose) const;
    Plane outside_plane(const Plane& plane, const Pose& pose) const;
    /// Where azimuth 0 of the readings lies in the outside frame.
    double azimuth_zero(const Pose& pose) const;
    /// A direction of the mesh's frame, inside.
    Vec3 inside_direction(const Vec3& direction) const;

    /// Index of the first extra unknown of a reading, or -1.
    int first_extra(int reading) const { return first_extra_[static_cast<std::size_t>(reading)]; }

private:
    class ReadingEquations;
    void bring_upright();
    /// By how much the mesh is too small for the lengths that were read.
    double scale_of_readings(const Vec3& up) const;
    void list_incidences(const FitOptions& options);
    void add_extras();
    /// What the facets' prior says (prior.h).
    std::vector<Equation> expected_equations() const;
    /// What outlines and photographs tell of the planes.
    std::vector<Equation> known_plane_equations() const;
    std::shared_ptr<const KnownPlanes> inside(const PlaneKnowledge& told,
                                              const glm::dmat3& upright) const;
    void list_known_planes();
    void pair_facets();
    /// At this shape, what they say is but one thing: facets lean one way, azimuths are less than
    /// half a turn off.
    bool may_be_merged(const std::vector<int>& group, const Replicates& replicates,
                       const Shape& shape) const;
    struct MergedReadings {
        std::vector<std::optional<Replicates>> replicates;  ///< with the first of each group
        std::vector<bool> is_merged;                        ///< into the first
    };
    MergedReadings merged_readings(const Shape& shape) const;
    /// Where the motion of a symmetry of all facets takes these; nothing where it is not known.
    std::optional<std::vector<int>> exchanged(const Reading& reading,
                                              const std::vector<int>& facets) const;
    std::vector<int> rotation_partners(const Reading& reading) const;
    std::vector<int> mirror_partners(const Reading& reading) const;
    void find_exchanges();
    void list_exact_motions();

    const Stone& stone_;
    std::vector<Reading> readings_;
    Solid solid_;  // the mesh, inside
    HalfEdges edges_;
    Shape mesh_shape_;
    std::shared_ptr<const Outline> mesh_outline_;
    std::vector<Incidence> incidences_;
    std::vector<int> first_extra_;
    std::vector<std::vector<int>> replicated_;             // readings of one quantity
    std::vector<std::vector<std::pair<int, int>>> pairs_;  // facets, of symmetry readings
    std::vector<std::optional<Automorphism>> exchanges_;   // of symmetry readings of all facets
    std::vector<SymmetryMotion> exact_motions_;
    std::vector<bool> fixed_extras_;
    PriorModel prior_;
    std::vector<std::shared_ptr<const KnownPlanes>> known_planes_;
    bool has_outlines_ = false;
    int up_facet_ = -1;
    bool splits_ = false;
    std::array<double, 2> group_sigmas_{};
    bool estimates_meets_ = false;
    double scale_ = 1;
    double mesh_scale_ = 1;  // the mesh was made this much larger to suit the lengths
    double turn_ = 0;        // about up, from the mesh to the inside
    Vec3 middle_{0, 0, 0};   // of the mesh, in the stone's unit
    // From the mesh's frame, and from the one that the result is told in.
    glm::dmat3 upright_{1}, outward_{1};
};

}  // namespace culet
