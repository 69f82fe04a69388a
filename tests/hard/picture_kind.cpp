// Cases of kind "picture": a whole render. Expectations: the reference renderer, the furnace (in a
// light of 1 from everywhere only what was pruned is darker), and invariance when everything moves
// together.
//
// Scenes name their engine; comparisons also draw with the reference. [view]: look_at_stone.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "render/beams/beam_shading.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "stone/text/errors.h"
#include "tests/hard/hard_scenes.h"

namespace culet::hard {

namespace {

struct PictureCase {
    Scene scene;
    std::optional<RenderResult> drawn;

    const RenderResult& result() {
        if (!drawn) drawn = render(scene);
        return *drawn;
    }
};

double brightness(const Picture& p) {
    double sum = 0;
    for (const float v : p.rgb) sum += std::abs(static_cast<double>(v));
    return sum / static_cast<double>(std::max<std::size_t>(p.rgb.size(), 1));
}

double apart(const Picture& a, const Picture& b, double factor = 1) {
    if (a.rgb.size() != b.rgb.size()) return 1e300;
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        sum += std::abs(static_cast<double>(a.rgb[i]) - factor * static_cast<double>(b.rgb[i]));
    }
    const double mean = factor * brightness(b) * static_cast<double>(b.rgb.size());
    return mean > 0 ? sum / mean : sum;
}

int not_numbers(const Picture& p) {
    int bad = 0;
    for (const float v : p.rgb) bad += !std::isfinite(v) || v < 0;
    for (const float v : p.coverage) bad += !(v >= 0 && v <= 1.0001f);
    for (const float v : p.standard_error) bad += !std::isfinite(v);
    return bad;
}

RenderResult with_threads(Scene scene, int threads) {
    scene.settings.threads = threads;
    return render(scene);
}

// Keeps the camera's direction; moves it to `from` diameters when given, with a lens that fits the
// picture to the stone times `fill`.
void look_at_stone(const TomlTable& view, Scene& scene) {
    view.refuse_unknown({"from", "fill"});
    Camera& camera = scene.camera;
    const double size = diameter(scene.stone.solid);
    if (const auto from = view.number("from")) {
        const Vec3 direction = glm::normalize(camera.position - camera.look_at);
        camera.look_at = centroid(scene.stone.solid);
        camera.position = camera.look_at + *from * size * direction;
    }
    const double distance = glm::length(camera.position - camera.look_at);
    camera.fov =
        2 * std::asin(std::min(0.95, 0.5 * view.number("fill").value_or(1) * size / distance));
}

}  // namespace

Subject picture_subject(const HardCase& hard_case, const HardPoint& point,
                        const TomlTable& parameters) {
    const auto c = std::make_shared<PictureCase>();
    Subject subject;
    auto& is = subject.invariants;
    std::string refusal;
    try {
        c->scene = hard_scene(hard_case, point, parameters);
        c->scene.settings.threads = 1;  // floating-point flags are per thread
        if (const auto view = parameters.table("view")) look_at_stone(*view, c->scene);
    } catch (const InputError& error) {
        refusal = error.what();
    }
    is["refused"] = [c, refusal] {
        if (!refusal.empty()) return Measured{0, std::nan(""), refusal};
        try {
            c->result();
        } catch (const InputError& error) {
            return Measured{0, std::nan(""), error.what()};
        }
        return Measured{1, std::nan(""), "was drawn"};
    };
    if (!refusal.empty()) {
        if (hard_case.invariants.contains("refused")) return subject;
        throw InputError(refusal);
    }
    is["finite"] = [c] {
        const RenderResult& r = c->result();
        const bool stats = std::isfinite(r.stats.mean_radiance + r.stats.remainder + r.stats.cut +
                                         r.stats.absorbed + r.stats.standard_error);
        return Measured{not_numbers(r.picture) + (stats ? 0.0 : 1.0), std::nan(""), ""};
    };
    is["furnace"] = [c] {
        double most = 0;
        for (const float v : c->result().picture.rgb) {
            most = std::max(most, static_cast<double>(v) - 1);
        }
        return Measured{most, std::nan(""), ""};
    };
    // Mean radiance and all losses add up to the furnace's light.
    is["energy"] = [c] {
        const RenderStats& s = c->result().stats;
        return Measured{std::abs(s.mean_radiance + s.remainder + s.cut + s.absorbed - 1),
                        std::nan(""), ""};
    };
    is["faces"] = [c] { return Measured{c->result().stats.worst_imbalance, std::nan(""), ""}; };
    is["lost_area"] = [c] {
        return Measured{std::abs(c->result().stats.lost_area), std::nan(""), ""};
    };
    // Relative to the picture's own bound.
    is["within_its_bound"] = [c] {
        Scene reference = c->scene;
        reference.settings.engine = "reference";
        const RenderResult exact = render(reference);
        const double error = apart(c->result().picture, exact.picture);
        return Measured{error / (c->result().stats.error_bound + exact.stats.error_bound + 1e-6),
                        std::nan(""),
                        fmt::format("mean difference {:.3g}, bounds {:.3g} and {:.3g}", error,
                                    c->result().stats.error_bound, exact.stats.error_bound)};
    };
    is["beside_the_reference"] = [c] {
        Scene reference = c->scene;
        reference.settings.engine = "reference";
        return Measured{apart(c->result().picture, render(reference).picture), std::nan(""), ""};
    };
    is["within_most_beams"] = [c] {
        const long long beams = c->result().stats.beams;
        return Measured{double(beams) / double(c->scene.settings.most_beams), std::nan(""),
                        fmt::format("{} beams", beams)};
    };
    is["threads"] = [c] {
        const RenderResult many = with_threads(c->scene, 5);
        return Measured{many.picture.rgb == c->result().picture.rgb ? 0.0 : 1.0, std::nan(""), ""};
    };
    // Every instruction set of this processor, against the chosen one.
    is["instruction_sets"] = [c] {
        const Picture first = c->result().picture;
        const std::vector<std::string> targets = shading_targets();
        Measured worst;
        for (const std::string& target : targets) {
            if (!use_shading_target(target)) continue;
            const RenderResult other = render(c->scene);
            const double error = apart(other.picture, first);
            if (!(error <= worst.error) || not_numbers(other.picture) > 0) {
                worst = {not_numbers(other.picture) > 0 ? 1e300 : error, std::nan(""), target};
            }
        }
        use_shading_target(targets.front());
        return worst;
    };
    is["turned"] = [c] {
        return Measured{
            apart(render(turned(c->scene, random_turn(7))).picture, c->result().picture),
            std::nan(""), ""};
    };
    is["reordered"] = [c] {
        return Measured{apart(render(reordered(c->scene, 3)).picture, c->result().picture),
                        std::nan(""), ""};
    };
    is["binary_units"] = [c] {
        return Measured{apart(render(scaled(c->scene, 0x1p-20)).picture, c->result().picture),
                        std::nan(""), ""};
    };
    is["units"] = [c] {
        return Measured{std::max(apart(render(scaled(c->scene, 1e-6)).picture, c->result().picture),
                                 apart(render(scaled(c->scene, 1e6)).picture, c->result().picture)),
                        std::nan(""), ""};
    };
    is["last_digit"] = [c] {
        return Measured{apart(render(nudged(c->scene, 5)).picture, c->result().picture),
                        std::nan(""), ""};
    };
    // As bright as its lights: against the same scene in a light of 1.
    is["as_bright_as_its_light"] = [c] {
        Scene plain = c->scene;
        const double was = c->scene.lights.constant;
        plain.lights.constant = 1;
        return Measured{apart(c->result().picture, render(plain).picture, was), std::nan(""), ""};
    };
    const std::string of = hard_case.section + "." + hard_case.name;
    is["files"] = [c, of] {
        const auto folder = std::filesystem::path(CULET_HARD_RESULTS) / "scenes" / of;
        double worst = 0;
        for (const char* kind : {"exr", "hdr", "png"}) {
            const auto file = folder / fmt::format("picture.{}", kind);
            write_picture(c->result().picture, file);
            const Picture back = read_picture(file).picture;
            std::filesystem::remove(file);
            worst += not_numbers(back);
            if (std::string(kind) == "exr") worst += apart(back, c->result().picture) > 1e-3;
        }
        return Measured{worst, std::nan(""), ""};
    };
    return subject;
}

}  // namespace culet::hard
