#pragma once
// One stone of a page: its scene, and the frames of its two engines. Private to the folder.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/beams/frame_renderer.h"
#include "render/gpu/gpu_setup.h"
#include "render/scene/scene.h"
#include "viewer/engine/viewer_document.h"

namespace culet {

struct FrameRequest {
    Camera camera;
    /// Rotation of the lights about the stone's middle, row by row.
    std::array<double, 9> turn{1, 0, 0, 0, 1, 0, 0, 0, 1};
    bool preview = false;
    /// For pictures while the stone moves: keep the last view's wavelengths where the scene leaves
    /// them open.
    bool quick = false;
    std::optional<int> samples;
};

/// Why a page cannot draw this, in words; empty: it can. Convex stones are drawn by beams, others
/// by rays: with `draw_quickly` for `preview`, else by the reference.
std::string refused_by_page(Scene scene);

class ShownStone {
public:
    ShownStone(ViewedStone viewed, const std::string& scene_toml, const HeldFiles& files,
               const std::string& name);

    /// Sets the scene's keys, as --set does. Throws InputError and then changes nothing.
    void set(const std::vector<std::string>& settings, const std::string& scene_toml,
             const HeldFiles& files, const std::string& name);

    const ViewedStone& viewed() const { return viewed_; }
    const Scene& scene() const { return scene_; }
    /// Why a page cannot draw it; empty: it can.
    const std::string& refused() const { return refused_; }

    const GpuSetup& on_gpu() const;

    Scene scene_of(const FrameRequest& request) const;
    /// Throws InputError. The picture is valid until the next call.
    const RenderResult& draw(const FrameRequest& request);

private:
    struct Drawer {
        FrameRenderer frames;
        std::optional<int> samples;
        bool stale = false;  ///< the scene's keys have changed since the last frame
    };

    ViewedStone viewed_;
    Scene scene_;
    std::string refused_, body_;
    mutable std::shared_ptr<const EnvironmentMap> coarse_map_;
    mutable std::optional<GpuSetup> on_gpu_;
    RenderResult traced_;
    std::array<std::unique_ptr<Drawer>, 2> drawers_;  ///< beams, preview
};

}  // namespace culet
