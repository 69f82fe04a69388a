#include "render/export/povray_objects.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <iterator>

#include "render/export/scene_parts.h"
#include "render/optics/conductor.h"
#include "render/scene/surface_colour.h"

namespace culet {

namespace {

struct ShapeText {
    double scale;

    std::string operator()(const SphereShape& s) const {
        return fmt::format("sphere {{ {}, {}", povray_vector(scale * s.center), scale * s.radius);
    }
    std::string operator()(const PlaneShape& s) const {
        return fmt::format("plane {{ {}, {}", povray_vector(s.normal),
                           scale * glm::dot(s.normal, s.point));
    }
    std::string operator()(const DiscShape& s) const {
        return fmt::format("disc {{ {}, {}, {}", povray_vector(scale * s.center),
                           povray_vector(s.normal), scale * s.radius);
    }
    std::string operator()(const BoxShape& s) const {
        // The matrix's rows are the images of x, y and z; the mirrored frame swaps y and z.
        const Vec3 half = scale * s.half;
        return fmt::format(
            "box {{ {0}, {1} matrix <{2}, {3}, {4}, {5}, {6}, {7}, {8}, {9}, {10}, {11}, {12}, "
            "{13}>",
            povray_vector(-half), povray_vector(half), s.axes[0].x, s.axes[0].z, s.axes[0].y,
            s.axes[2].x, s.axes[2].z, s.axes[2].y, s.axes[1].x, s.axes[1].z, s.axes[1].y,
            scale * s.center.x, scale * s.center.z, scale * s.center.y);
    }
    std::string operator()(const MeshShape& s) const {
        const TriangleMesh& mesh = *s.mesh;
        std::string text = fmt::format("mesh2 {{ vertex_vectors {{ {}\n", mesh.vertices.size());
        const auto add = std::back_inserter(text);
        for (const Vec3& v : mesh.vertices)
            fmt::format_to(add, "    {}\n", povray_vector(scale * v));
        fmt::format_to(add, "  }} face_indices {{ {}\n", mesh.triangles.size());
        for (const auto& t : mesh.triangles)
            fmt::format_to(add, "    <{}, {}, {}>\n", t[0], t[1], t[2]);
        text += "  }";
        return text;
    }
};

struct SurfaceText {
    double scale, immersion;
    std::vector<std::string>& notes;

    std::string operator()(const DiffuseMaterial& m) const {
        add_note(notes, "light on diffuse surfaces, which POV-Ray takes from light_source alone");
        return fmt::format("pigment {{ {} }} finish {{ ambient 0 diffuse 1 }}",
                           povray_colour(rgb_of(m.albedo)));
    }
    std::string operator()(const MetalMaterial& m) const {
        add_note(notes, "metals' Fresnel reflection and roughness: they reflect f0 at every angle");
        Rgb f0{};
        if (m.f0) {
            f0 = rgb_of(*m.f0);
        } else {
            const Rgb n = rgb_of(m.n), k = rgb_of(m.k);
            for (std::size_t c = 0; c < 3; ++c) f0[c] = conductor_reflectance(n[c], k[c], 1);
        }
        return mirror(f0);
    }
    std::string operator()(const MirrorMaterial& m) const { return mirror(rgb_of(m.albedo)); }
    std::string operator()(const DielectricMaterial& m) const {
        std::string text = fmt::format(
            "pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 specular 0 reflection {{ 0, 1 "
            "fresnel on }} conserve_energy }} hollow interior {{ ior {}",
            m.index / immersion);
        Rgb absorption = rgb_of(m.absorption);
        for (double& a : absorption) a /= scale;
        if (absorption != Rgb{})
            text += fmt::format(" media {{ absorption {} }}", povray_colour(absorption));
        return text + " }";
    }
    std::string operator()(const EmitterMaterial& m) const {
        Rgb radiance{1, 1, 1};
        if (const double* number = std::get_if<double>(&m.radiance.value)) {
            radiance = {*number, *number, *number};
        } else if (const Rgb* rgb = std::get_if<Rgb>(&m.radiance.value)) {
            radiance = *rgb;
        } else {
            add_note(notes, "spectra of emitters: they are white");
        }
        return fmt::format("pigment {{ {} }} finish {{ ambient 0 diffuse 0 emission 1 }}",
                           povray_colour(radiance));
    }

private:
    static std::string mirror(const Rgb& share) {
        return fmt::format(
            "pigment {{ rgb 0 }} finish {{ ambient 0 diffuse 0 reflection {{ {} }} }}",
            povray_colour(share));
    }
};

}  // namespace

std::string povray_vector(const Vec3& v) {
    return fmt::format("<{}, {}, {}>", v.x, v.z, v.y);
}

std::string povray_colour(const Rgb& rgb) {
    return fmt::format("rgb <{}, {}, {}>", rgb[0], rgb[1], rgb[2]);
}

std::string povray_object(const SceneObject& object, double scale, double immersion,
                          std::vector<std::string>& notes) {
    return std::visit(ShapeText{scale}, object.shape) + " " +
           std::visit(SurfaceText{scale, immersion, notes}, object.material) + " }";
}

}  // namespace culet
