#pragma once
// Base of the writers of scenes for other renderers. Private to this folder.

#include <fmt/format.h>

#include <iterator>
#include <string>

#include "render/export/optical_parts.h"
#include "render/export/scene_parts.h"

namespace culet {

class SceneWriter {
protected:
    explicit SceneWriter(const Scene& scene)
        : scene_(scene), lights_(scene), size_(size_of(scene)) {}

    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(result_.text), format, std::forward<Args>(args)...);
        result_.text += '\n';
    }
    void note(const std::string& text) { add_note(result_.notes, text); }
    Rgb rgb_of_light(const LightColour& light) { return lights_.of(light, result_.notes); }

    /// Calls near(light), stone(stone) and object(object) of `writer`.
    template <class Writer>
    void everything_by(Writer& writer) {
        for (const Light& light : scene_.lights.sources) {
            std::visit(
                [&](const auto& l) {
                    using L = std::decay_t<decltype(l)>;
                    if constexpr (std::is_same_v<L, LampLight>) {
                        note("a lamp's photometry: it shines as towards the target in all ways");
                        writer.near(SphereLight{l.center, l.radius, towards_target(l)});
                    } else if constexpr (L::k_is_near) {
                        writer.near(l);
                    }
                },
                light);
        }
        if (scene_.has_stone()) writer.stone(scene_.stone);
        for (const Stone& more : scene_.more_stones) writer.stone(more);
        for (const SceneObject& object : scene_.objects) writer.object(object);
    }

    LightColour towards_target(const LampLight& lamp) const {
        const double share = share_of(lamp, lamp.center - scene_.camera.look_at);
        return scaled(lamp.radiance, share);
    }

    const Scene& scene_;
    LightRgb lights_;
    double size_;
    ExportedScene result_;
};

inline constexpr const char* k_planes_end =
    "infinite planes: they end 1000 sizes of the stone away";
inline constexpr const char* k_black_behind =
    "that a plane light is not there from behind: it is black";

}  // namespace culet
