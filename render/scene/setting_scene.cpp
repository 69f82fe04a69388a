#include "render/scene/setting_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_fov_deg = 20;
// Direction of the eye from the mounting's middle: across the hoop, from the side and above.
const Vec3 k_toward_eye{0.72, -0.42, 0.55};
// As parts of a ring's height: the picture's middle below the top, and half the visible height.
constexpr double k_ring_middle = 0.29, k_ring_shown = 0.385;
constexpr double k_polished = 0.15;  // roughness of a worn polish

std::string quoted_name(const std::filesystem::path& file, const std::filesystem::path& from) {
    const std::filesystem::path folder = std::filesystem::absolute(from).parent_path();
    const std::string name =
        std::filesystem::absolute(file).lexically_proximate(folder).generic_string();
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 127; }))
        throw InputError(file, "has a name that a scene cannot hold: rename it");
    std::string quoted = "\"";
    for (const char c : name) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + "\"";
}

std::string list(Vec3 v) {
    // Lengths that are only rounding errors are written as 0.
    constexpr double k_rounding = 1e-9;
    for (int i = 0; i < 3; ++i)
        if (std::abs(v[i]) < k_rounding) v[i] = 0;
    return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x, v.y, v.z);
}

}  // namespace

std::string setting_scene(const SettingScene& files, const Setting& setting) {
    std::string text =
        fmt::format("# {}\n{} = {}\n", files.made_by, files.is_stone_file ? "stone" : "mesh",
                    quoted_name(files.stone, files.scene));
    if (!files.material.empty()) {
        const bool is_file = std::filesystem::path(files.material).extension() == ".toml";
        text += fmt::format("material = {}\n", is_file ? quoted_name(files.material, files.scene)
                                                       : "\"" + files.material + "\"");
    }
    if (!files.is_stone_file && !files.convex) text += "convex = false\n";
    // A head's bounding ball fills the picture's height. A ring's lower part is cut off, so that
    // the stone is large enough.
    Vec3 middle = 0.5 * (setting.low + setting.high);
    double shown = 0.5 * glm::length(setting.high - setting.low);
    if (setting.options.shank) {
        const double height = setting.high.z - setting.low.z;
        middle.z = setting.high.z - k_ring_middle * height;
        shown = k_ring_shown * height;
    }
    const double distance = shown / std::sin(radians(0.5 * k_fov_deg));
    const Vec3 eye = middle + distance * glm::normalize(k_toward_eye);
    text += fmt::format(
        "\n[camera]\nposition = {}\nlook_at = {}\nup = {}\nfov = {}\nsize = [600, 450]\n",
        list(setting.in_frame_of_stone(eye)), list(setting.in_frame_of_stone(middle)),
        list(setting.up), k_fov_deg);
    text += "\n[light]\npreset = \"lightbox\"\n";
    text += fmt::format(
        "\n[[object]]  # the mounting, in {}\nshape = \"mesh\"\nfile = {}\nsmooth = true\n"
        "material = {{ kind = \"metal\", f0 = [{}, {}, {}], roughness = {} }}\n",
        files.metal.name, quoted_name(files.setting, files.scene), files.metal.f0[0],
        files.metal.f0[1], files.metal.f0[2], k_polished);
    text += fmt::format(
        "\n[[object]]  # what it stands on\nshape = \"plane\"\npoint = {}\nnormal = {}\n"
        "material = {{ kind = \"diffuse\", albedo = 0.5 }}\n",
        list(setting.in_frame_of_stone({0, 0, setting.low.z})), list(setting.up));
    text += "\n[render]\nsamples = 16\n";
    return text;
}

}  // namespace culet
