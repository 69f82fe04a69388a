#include "stone/solid/half_edges.h"

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <tuple>

#include "stone/text/errors.h"

namespace culet {

namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

// OpenMesh reports refused faces on stderr; our library must not print.
class SilentOpenMesh {
public:
    SilentOpenMesh() : was_enabled_(omerr().is_enabled()) { omerr().disable(); }
    ~SilentOpenMesh() {
        if (was_enabled_) omerr().enable();
    }
    SilentOpenMesh(const SilentOpenMesh&) = delete;
    SilentOpenMesh& operator=(const SilentOpenMesh&) = delete;

private:
    bool was_enabled_;
};

}  // namespace

HalfEdges half_edges(const Solid& solid) {
    const char* const not_manifold =
        "half_edges needs a closed manifold: find_faults was not asked";
    const SilentOpenMesh silent;
    Mesh mesh;
    for (const Vec3& v : solid.vertices) mesh.add_vertex({v.x, v.y, v.z});
    std::vector<std::size_t> facet_count(solid.vertices.size(), 0);
    for (const Facet& facet : solid.facets) {
        std::vector<Mesh::VertexHandle> corners;
        for (const int corner : facet.corners) {
            check(corner >= 0 && corner < static_cast<int>(solid.vertices.size()), not_manifold);
            corners.emplace_back(corner);
            ++facet_count[corner];
        }
        std::vector<int> distinct = facet.corners;
        std::sort(distinct.begin(), distinct.end());
        check(distinct.size() >= 3 &&
                  std::adjacent_find(distinct.begin(), distinct.end()) == distinct.end(),
              not_manifold);
        check(mesh.add_face(corners).is_valid(), not_manifold);
    }

    HalfEdges result;
    result.edges.reserve(mesh.n_edges());
    for (const auto edge : mesh.edges()) {
        check(!mesh.is_boundary(edge), not_manifold);
        auto along = mesh.halfedge_handle(edge, 0);
        if (mesh.from_vertex_handle(along).idx() > mesh.to_vertex_handle(along).idx()) {
            along = mesh.opposite_halfedge_handle(along);
        }
        result.edges.push_back({mesh.from_vertex_handle(along).idx(),
                                mesh.to_vertex_handle(along).idx(), mesh.face_handle(along).idx(),
                                mesh.face_handle(mesh.opposite_halfedge_handle(along)).idx()});
    }
    std::sort(result.edges.begin(), result.edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    });

    result.facets_of_vertex.resize(solid.vertices.size());
    for (const auto vertex : mesh.vertices()) {
        std::vector<int>& facets = result.facets_of_vertex[vertex.idx()];
        for (auto f = mesh.cvf_ccwbegin(vertex); f.is_valid(); ++f) facets.push_back(f->idx());
        // Of two fans that share a vertex only one is visited.
        check(facets.size() == facet_count[vertex.idx()], not_manifold);
        std::rotate(facets.begin(), std::min_element(facets.begin(), facets.end()), facets.end());
    }
    return result;
}

}  // namespace culet
