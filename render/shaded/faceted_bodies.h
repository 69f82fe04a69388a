#pragma once
// The contents of a scene as bodies of flat facets, for shadings that colour facets and vertices.

#include <memory>
#include <vector>

#include "render/objects/object_world.h"
#include "render/shaded/plain_surface.h"

namespace culet {

/// A triangle mesh. Its facets are a stone's facets, the sides of a box, or the triangles of a mesh
/// or a tessellated sphere.
struct FacetedBody {
    std::shared_ptr<const TriangleMesh> mesh;
    std::vector<int> facet_of;  ///< per triangle
    struct Face {
        Vec3 middle{0, 0, 0}, normal{0, 0, 1};  ///< mean of its corners; unit, outwards
    };
    std::vector<Face> facets;
    /// Unit normals of each triangle's corners: the mesh's own, or the mean, by area, of the facets
    /// that meet there.
    std::vector<std::array<Vec3, 3>> corner_normals;

    /// Barycentric coordinates of a point in a triangle; none below 0, sum 1.
    std::array<double, 3> weights(int triangle, const Vec3& point) const;
};

/// Everything in a scene, including stones, as one list. Spheres have bodies if `tessellated`;
/// planes and discs have none.
class FacetedBodies {
public:
    FacetedBodies(const Scene& scene, bool tessellated);

    int size() const { return static_cast<int>(surfaces_.size()); }
    /// Null for a plane, a disc or an untessellated sphere.
    const FacetedBody* body(int i) const { return bodies_[static_cast<std::size_t>(i)].get(); }
    const PlainSurface& surface(int i) const { return surfaces_[static_cast<std::size_t>(i)]; }
    /// A point of an infinite plane or a disc.
    Vec3 middle(int i) const;
    const ObjectWorld& world() const { return *world_; }

private:
    std::vector<std::unique_ptr<FacetedBody>> bodies_;
    std::vector<PlainSurface> surfaces_;
    std::unique_ptr<const ObjectWorld> world_;
};

/// Middle of all stones and objects except infinite planes; without any, the camera's look_at.
Vec3 middle_of(const Scene& scene);

}  // namespace culet
