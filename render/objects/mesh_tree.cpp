#include "render/objects/mesh_tree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/text/errors.h"

namespace culet {

namespace {

// Smallest distance of a hit in the unit sphere. For rays that start on a triangle, nearer hits of
// its neighbours come only from the rounding of single precision and of Embree's few operations.
constexpr float k_nearest = 8 * 0x1p-24f;

// The ray's start, for the filter.
struct Context {
    RTCIntersectContext embree;
    unsigned object, triangle;
};

void pass_over_start(const RTCFilterFunctionNArguments* arguments) {
    const auto* context = reinterpret_cast<const Context*>(arguments->context);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    if (hit->geomID == context->object && hit->primID == context->triangle) arguments->valid[0] = 0;
}

}  // namespace

struct MeshTree::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    ~Embree() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

MeshTree::~MeshTree() = default;

MeshTree::MeshTree(const std::vector<SceneObject>& objects) {
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    bool any = false;
    for (const SceneObject& object : objects) {
        const auto* shape = std::get_if<MeshShape>(&object.shape);
        meshes_.push_back(shape != nullptr ? shape->mesh : nullptr);
        if (shape == nullptr) continue;
        any = true;
        for (const Vec3& vertex : shape->mesh->vertices) {
            low = glm::min(low, vertex);
            high = glm::max(high, vertex);
        }
    }
    if (!any) return;
    center_ = 0.5 * (low + high);
    radius_ = 0.5 * glm::length(high - low);
    embree_ = std::make_unique<Embree>();
    embree_->device = rtcNewDevice(nullptr);
    if (embree_->device == nullptr) throw InternalError("Embree gives no device");
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(
        embree_->scene,
        static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        if (!meshes_[i]) continue;
        const TriangleMesh& mesh = *meshes_[i];
        const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), mesh.vertices.size()));
        auto* corners = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(unsigned), mesh.triangles.size()));
        if (vertices == nullptr || corners == nullptr)
            throw InputError("the meshes around the stone do not fit into memory");
        for (const Vec3& vertex : mesh.vertices) {
            const Vec3 v = (vertex - center_) / radius_;
            for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(v[k]);
        }
        for (const auto& triangle : mesh.triangles) {
            for (const int corner : triangle) *corners++ = static_cast<unsigned>(corner);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(embree_->scene, geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree_->scene);
    if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE)
        throw InputError("the meshes around the stone do not fit into memory");
}

std::optional<TriangleHit> MeshTree::nearest(const Vec3& origin, const Vec3& direction, int object,
                                             int triangle) const {
    if (!embree_) return std::nullopt;
    // Start in the sphere around all meshes, where single precision is most accurate.
    const Vec3 from_center = origin - center_;
    const double b = glm::dot(from_center, direction);
    const Vec3 nearest = from_center - b * direction;
    const double below = radius_ * radius_ - glm::dot(nearest, nearest);
    if (!(below >= 0)) return std::nullopt;
    const double half = std::sqrt(below);
    if (!(half - b > 0)) return std::nullopt;
    const double skipped = std::max(0.0, -b - half);
    const Vec3 start = (from_center + skipped * direction) / radius_;

    Context context;
    rtcInitIntersectContext(&context.embree);
    context.object = static_cast<unsigned>(object);
    context.triangle = static_cast<unsigned>(triangle);
    const bool on_mesh = object >= 0 && meshes_[static_cast<std::size_t>(object)];
    if (on_mesh) context.embree.filter = pass_over_start;
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(start.x);
    ray.ray.org_y = static_cast<float>(start.y);
    ray.ray.org_z = static_cast<float>(start.z);
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = static_cast<float>(direction.z);
    ray.ray.tnear = on_mesh ? k_nearest : 0;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->scene, &context.embree, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

    TriangleHit hit;
    hit.object = static_cast<int>(ray.hit.geomID);
    hit.triangle = static_cast<int>(ray.hit.primID);
    const TriangleMesh& mesh = *meshes_[ray.hit.geomID];
    const auto& corners = mesh.triangles[ray.hit.primID];
    const auto at = [&](std::size_t k) {
        return mesh.vertices[static_cast<std::size_t>(corners[k])];
    };
    hit.normal = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
    const double rate = glm::dot(hit.normal, direction);
    const double exact = glm::dot(hit.normal, at(0) - origin) / rate;
    const double single = skipped + radius_ * static_cast<double>(ray.ray.tfar);
    // Along the triangle's plane the exact distance is ill-conditioned and may lie beyond all
    // meshes.
    hit.distance = exact >= skipped && exact <= half - b ? exact : single;
    hit.shading = hit.normal;
    if (!mesh.corner_normals.empty()) {
        const auto& normals = mesh.corner_normals[ray.hit.primID];
        const double u = static_cast<double>(ray.hit.u), v = static_cast<double>(ray.hit.v);
        const Vec3 sum = (1 - u - v) * normals[0] + u * normals[1] + v * normals[2];
        if (glm::dot(sum, sum) > 0) hit.shading = glm::normalize(sum);
    }
    return hit;
}

}  // namespace culet
