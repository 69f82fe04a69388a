// Stand-ins for what only the program has: files, and what needs libraries that a page lacks.

#include "render/engine/engine.h"
#include "render/image/colour_profile.h"
#include "render/image/glare.h"
#include "render/image/image_io.h"
#include "render/reference/light_field.h"
#include "render/scene/engine_name.h"
#include "render/scene/lamp_io.h"
#include "render/scene/photometry.h"
#include "stone/design/tiers.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/material/wavelength_table.h"
#include "stone/mesh/mesh_formats.h"
#include "stone/mesh/surface_mesh.h"
#include "stone/solid/half_edges.h"
#include "stone/stone.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/path_fence.h"

namespace culet {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
    throw InputError(file, "is a file, and a page reads only what it was given");
}

}  // namespace

std::string read_text(const std::filesystem::path& file, std::size_t) {
    refuse(file);
}
void require_file(const std::filesystem::path&) {}  // what a page was given is there
void require_within_fence(const std::filesystem::path&) {}
std::string foreign_kind_of(const std::filesystem::path&) {
    return {};
}
ReadCut parse_gcs(std::string_view, const CutReading&, const std::filesystem::path& file) {
    throw InputError(file, "is not read by a page: culet convert makes an .asc of it");
}
LampLight lamp_of(const TomlTable&, LengthUnit) {
    throw InputError("a lamp's photometry is a file, and a page reads only what it was given");
}
double Photometry::at(const glm::dvec3&) const {
    throw InternalError("a page has no lamps");
}
// Of a design, which a page does not show.
std::vector<FacetTier> tiers_of(const Solid&, const Vec3&) {
    return {};
}
Spectrum read_wavelength_table(const std::filesystem::path& file, const char*,
                               std::vector<std::string>&) {
    refuse(file);
}
TriangleMesh read_triangle_mesh(const std::filesystem::path& file) {
    refuse(file);
}
TriangleMesh read_gltf(const std::filesystem::path& file) {
    refuse(file);
}
FaceSoup read_step(const std::filesystem::path& file) {
    refuse(file);
}
bool is_step(const std::filesystem::path&) {
    return false;
}
bool is_gltf(const std::filesystem::path&) {
    return false;
}
void smooth_normals(TriangleMesh&, double) {
    throw InternalError("a page has no meshes around the stone");
}
ReadPicture read_picture(const std::filesystem::path& file) {
    refuse(file);
}

ColourProfile::ColourProfile(const std::string&, std::size_t channels)
    : channels_(channels), of_profile_(channels), trouble_("a page follows no ICC profile") {}
bool ColourProfile::is_srgb() const {
    return false;
}
void ColourProfile::linear(const float*, std::size_t, float*) const {}

// A scene may name any engine; the page draws with beams.
std::vector<std::string> engine_names() {
    return {
        k_auto_engine, k_reference_engine, k_beam_engine,     k_preview_engine, "flat", "gouraud",
        "phong",       "whitted",          k_raytable_engine, k_gpu_engine};
}

const Engine& reference_engine();  // render/reference/reference_engine.cpp

// Other stones are drawn by frames of beams.
const Engine& engine_named(const std::string& name) {
    check(name == k_reference_engine, "a page has one engine for stones that are not convex");
    return reference_engine();
}

// `ViewerEngine` shows pictures without it.
void add_glare(std::vector<float>&, const PictureSize&, double, double) {
    throw InternalError("a page draws no glare");
}

// Called only for stones of more than some ten thousand facets (convexity.cpp).
HalfEdges half_edges(const Solid&) {
    throw InputError("the stone has too many facets for a page");
}

// Beams draw a single stone only.
std::unique_ptr<const Surroundings> surroundings_of(const Scene& scene,
                                                    const WavelengthSet& wavelengths) {
    if (scene.has_objects()) throw InputError("a page draws one stone alone, without objects");
    return std::make_unique<LightField>(scene.lights, wavelengths);
}

}  // namespace culet
