// References: ISO 10303-21 (the text), 10303-42 (geometry and topology), 10303-214 (the entities of
// a product).

#include "stone/export/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <map>
#include <utility>

#include "stone/solid/checks.h"
#include "stone/solid/facet_triangles.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"

namespace culet {

namespace {

// CAD programs merge points that are nearer than this (OCCT's Precision::Confusion, in mm).
constexpr double k_least_uncertainty_mm = 1e-7;
// A tenth of the resolution of the coarsest usual CAD kernels (1e-4 mm).
constexpr double k_most_uncertainty_mm = 1e-5;

// Part 21 requires a point in real numbers.
std::string real(double value) {
    std::string text = fmt::format("{}", value == 0 ? 0.0 : value);
    const std::size_t exponent = text.find('e');
    std::string digits = text.substr(0, exponent);
    if (digits.find('.') == std::string::npos) digits += '.';
    return exponent == std::string::npos ? digits : digits + "E" + text.substr(exponent + 1);
}

// Doubles quotes and backslashes, writes what is beyond ASCII as \X4\, drops control characters.
std::string step_string(std::string_view text) {
    std::string result = "'";
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t start = i;
        std::int32_t code = next_code_point(text, i);
        // A byte that is not UTF-8 stands for itself.
        if (code < 0) code = static_cast<unsigned char>(text[start]);
        if (code == '\'' || code == '\\') {
            result.append(2, static_cast<char>(code));
        } else if (code >= 0x20 && code < 0x7f) {
            result += static_cast<char>(code);
        } else if (code >= 0xa0) {
            result += fmt::format("\\X4\\{:08X}\\X0\\", static_cast<unsigned>(code));
        } else {
            result += '_';
        }
    }
    return result + "'";
}

struct StepFace {
    std::string name;
    Plane plane;
    std::vector<int> corners;
};

double largest_miss(const Solid& solid, const StepFace& face) {
    double miss = 0;
    for (const int corner : face.corners)
        miss = std::max(miss, std::abs(height_above(
                                  face.plane, solid.vertices[static_cast<std::size_t>(corner)])));
    return miss;
}

Plane plane_of(const Solid& solid, const std::vector<int>& corners) {
    std::vector<Vec3> loop;
    for (const int corner : corners)
        loop.push_back(solid.vertices[static_cast<std::size_t>(corner)]);
    return plane_through(loop);
}

class StepWriter {
public:
    StepWriter(const Solid& solid, std::string name) : solid_(solid), name_(std::move(name)) {}

    StepFile write() {
        find_faces();
        header();
        const int solid = body();
        product(solid);
        result_.text += "ENDSEC;\nEND-ISO-10303-21;\n";
        return std::move(result_);
    }

private:
    template <class... Args>
    int entity(fmt::format_string<Args...> format, Args&&... args) {
        ++last_;
        fmt::format_to(std::back_inserter(result_.text), "#{}=", last_);
        fmt::format_to(std::back_inserter(result_.text), format, std::forward<Args>(args)...);
        result_.text += ";\n";
        return last_;
    }

    void find_faces() {
        int cut = 0;
        double miss = 0;
        for (const Facet& facet : solid_.facets) {
            StepFace face{facet.name, facet.plane, facet.corners};
            if (largest_miss(solid_, face) > k_most_uncertainty_mm) {
                // A drawn facet's stated plane may differ from that of its corners.
                face.plane = plane_of(solid_, facet.corners);
            }
            if (largest_miss(solid_, face) <= k_most_uncertainty_mm) {
                miss = std::max(miss, largest_miss(solid_, face));
                faces_.push_back(std::move(face));
                continue;
            }
            ++cut;
            for (const std::array<int, 3>& t : facet_triangles(solid_, facet)) {
                const std::vector<int> corners(t.begin(), t.end());
                faces_.push_back({facet.name, plane_of(solid_, corners), corners});
                miss = std::max(miss, largest_miss(solid_, faces_.back()));
            }
        }
        if (cut > 0) {
            result_.notes.push_back(
                fmt::format("{} of {} facets are not planar to {:g} mm: written as named triangles",
                            cut, solid_.facets.size(), k_most_uncertainty_mm));
        }
        // Round up to a power of ten.
        result_.uncertainty_mm = k_least_uncertainty_mm;
        while (result_.uncertainty_mm < miss) result_.uncertainty_mm *= 10;
    }

    void header() {
        // No date, so that the same stone gives the same bytes; not every program reads the
        // standard's empty date.
        result_.text = fmt::format(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('faceted stone, mm'),'2;1');\n"
            "FILE_NAME({},'1970-01-01T00:00:00',(''),(''),'culet','culet','');\n"
            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n",
            step_string(name_));
    }

    int point(const Vec3& p) {
        return entity("CARTESIAN_POINT('',({},{},{}))", real(p.x), real(p.y), real(p.z));
    }
    int direction(const Vec3& d) {
        return entity("DIRECTION('',({},{},{}))", real(d.x), real(d.y), real(d.z));
    }
    int placement(const Vec3& origin, const Vec3& z, const Vec3& x) {
        const int at = point(origin), axis = direction(z), reference = direction(x);
        return entity("AXIS2_PLACEMENT_3D('',#{},#{},#{})", at, axis, reference);
    }

    const Vec3& vertex(int corner) const {
        return solid_.vertices[static_cast<std::size_t>(corner)];
    }

    int vertex_entity(int corner) {
        const auto known = vertices_.find(corner);
        if (known != vertices_.end()) return known->second;
        const int at = point(vertex(corner));
        points_[corner] = at;
        return vertices_[corner] = entity("VERTEX_POINT('',#{})", at);
    }

    // The edge runs from its first corner to its second; the other face uses it reversed.
    int edge(int from, int to) {
        const std::pair<int, int> key{std::min(from, to), std::max(from, to)};
        const auto known = edges_.find(key);
        if (known != edges_.end()) return known->second;
        const int start = vertex_entity(key.first), end = vertex_entity(key.second);
        const Vec3 along = glm::normalize(vertex(key.second) - vertex(key.first));
        const int heading = direction(along);
        const int vector = entity("VECTOR('',#{},1.)", heading);
        const int line = entity("LINE('',#{},#{})", points_.at(key.first), vector);
        return edges_[key] = entity("EDGE_CURVE('',#{},#{},#{},.T.)", start, end, line);
    }

    int face(const StepFace& face) {
        std::vector<int> bound;
        for (std::size_t i = 0; i < face.corners.size(); ++i) {
            const int from = face.corners[i], to = face.corners[(i + 1) % face.corners.size()];
            const int shared = edge(from, to);
            bound.push_back(
                entity("ORIENTED_EDGE('',*,*,#{},{})", shared, from < to ? ".T." : ".F."));
        }
        const int loop = entity("EDGE_LOOP('',({}))", list(bound));
        const int outer = entity("FACE_OUTER_BOUND('',#{},.T.)", loop);
        // A point of the plane (the corner, projected) and any direction in it.
        const Vec3& normal = face.plane.normal;
        const Vec3 first = vertex(face.corners[0]);
        Vec3 along = vertex(face.corners[1]) - first;
        along = glm::normalize(along - glm::dot(along, normal) * normal);
        const int axes = placement(first - height_above(face.plane, first) * normal, normal, along);
        const int plane = entity("PLANE('',#{})", axes);
        return entity("ADVANCED_FACE({},(#{}),#{},.T.)", step_string(face.name), outer, plane);
    }

    int body() {
        std::vector<int> faces;
        for (const StepFace& each : faces_) faces.push_back(face(each));
        const int shell = entity("CLOSED_SHELL('',({}))", list(faces));
        return entity("MANIFOLD_SOLID_BREP({},#{})", step_string(name_), shell);
    }

    // Makes the solid a part in millimetres.
    void product(int solid) {
        const int origin = placement({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
        const int mm = entity("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
        const int radian = entity("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
        const int steradian = entity("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
        const int uncertainty = entity(
            "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({}),#{},'distance_accuracy_value','"
            "largest distance of a corner from its faces')",
            real(result_.uncertainty_mm), mm);
        const int context = entity(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{}))"
            "GLOBAL_UNIT_ASSIGNED_CONTEXT((#{},#{},#{}))REPRESENTATION_CONTEXT('','3D'))",
            uncertainty, mm, radian, steradian);
        const int shape = entity("ADVANCED_BREP_SHAPE_REPRESENTATION({},(#{},#{}),#{})",
                                 step_string(name_), origin, solid, context);
        const int application = entity("APPLICATION_CONTEXT('automotive design')");
        entity(
            "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2010,"
            "#{})",
            application);
        const int product_context = entity("PRODUCT_CONTEXT('',#{},'mechanical')", application);
        const int product =
            entity("PRODUCT({0},{0},'',(#{1}))", step_string(name_), product_context);
        entity("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#{}))", product);
        const int formation = entity("PRODUCT_DEFINITION_FORMATION('','',#{})", product);
        const int definition_context =
            entity("PRODUCT_DEFINITION_CONTEXT('part definition',#{},'design')", application);
        const int definition =
            entity("PRODUCT_DEFINITION('design','',#{},#{})", formation, definition_context);
        const int definition_shape = entity("PRODUCT_DEFINITION_SHAPE('','',#{})", definition);
        entity("SHAPE_DEFINITION_REPRESENTATION(#{},#{})", definition_shape, shape);
    }

    static std::string list(const std::vector<int>& entities) {
        std::string text;
        for (const int entity : entities)
            text += fmt::format("{}#{}", text.empty() ? "" : ",", entity);
        return text;
    }

    const Solid& solid_;
    std::string name_;
    std::vector<StepFace> faces_;
    std::map<int, int> vertices_, points_;      // entities by corner
    std::map<std::pair<int, int>, int> edges_;  // by corners, the smaller first
    StepFile result_;
    int last_ = 0;
};

}  // namespace

StepFile step_text(const Solid& solid_mm, const std::string& name) {
    const std::vector<Fault> faults =
        find_faults(solid_mm, {.planarity = 1, .must_be_convex = false});
    for (const Fault& fault : faults) {
        if (fault.kind == FaultKind::repeated_name || fault.kind == FaultKind::unused_vertex ||
            fault.kind == FaultKind::not_planar)
            continue;
        throw InputError(fmt::format("a STEP file holds closed bodies only: {}: {}",
                                     name_of(fault.kind), fault.what));
    }
    return StepWriter(solid_mm, name).write();
}

}  // namespace culet
