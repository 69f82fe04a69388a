#include "studio/cut_work.h"

#include <fmt/format.h>

#include <cmath>

#include "compare/study/graded_design.h"
#include "page/drawing.h"
#include "render/grade/grade_json.h"
#include "render/optimize/optimized_json.h"
#include "stone/design/design.h"
#include "stone/export/export_frame.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid_input.h"
#include "stone/text/errors.h"
#include "studio/cut_handles.h"
#include "studio/fit_work.h"
#include "studio/json_text.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Solid solid_of(const std::string& text) {
    return solid_of_bytes(text, "tried.obj").solid;
}

// A design states its index; the colours of other stones without a material are diamond's.
bool has_material(const CutGround& ground) {
    const Solid& solid = ground.loaded->file.stone.solid;
    return ground.loaded->file.has_material || !solid.design || !solid.design->refractive_index;
}

GradeIndex index_of(const CutGround& ground) {
    if (!has_material(ground))
        return grade_index(nullptr, ground.loaded->file.stone.solid.design->refractive_index);
    const Stone stone = stone_shown(*ground.loaded, {});
    return grade_index(&stone.material, std::nullopt);
}

std::string index_words(const CutGround& ground) {
    const double n = index_of(ground).n;
    if (ground.loaded->file.has_material)
        return fmt::format("{}, index {:.4f}", ground.loaded->file.stone.material.name, n);
    return has_material(ground)
               ? fmt::format("The stone file names no material: as diamond, index {:.4f}", n)
               : fmt::format("The index of the design, {:.4f}", n);
}

MeritOptions merit_options(const CutGround& ground, bool all_parts) {
    MeritOptions options;
    options.index = index_of(ground);
    if (all_parts) options.weights = {1, options.index.fire ? 1.0 : 0.0, 1, 1};
    return options;
}

Json tiers_json(const TierDesign& design, const Solid& solid) {
    Json json = Json::array();
    for (const CutHandle& handle : handles_of(design, solid)) {
        Json facets = Json::array();
        for (const int t : handle.tiers) {
            for (const int f : design.tiers()[std::size_t(t)].facets)
                facets.push_back(solid.facets[std::size_t(f)].name);
        }
        json.push_back({{"name", handle.name},
                        {"part", handle.is_height ? "" : name_of(handle.part)},
                        {"unit", handle.is_height ? "per cent of the width" : "degrees"},
                        {"facets", std::move(facets)},
                        {"value", handle.value}});
    }
    return json;
}

Json figures_json(const Solid& solid, const MeritOptions& options) {
    const Merit merit = merit_of(solid, options);
    Json json = Json::array();
    constexpr std::array<const char*, k_merit_part_count> k_words{
        "light return, mean of tilts to 30 degrees", "fire", "contrast: what the head darkens",
        "light return at 20 degrees over face up"};
    for (std::size_t p = 0; p < merit.parts.size(); ++p) {
        if (options.weights[p] > 0)
            json.push_back({{"name", name_of(static_cast<MeritPart>(p))},
                            {"words", k_words[p]},
                            {"value", merit.parts[p]}});
    }
    json.push_back(
        {{"name", "table"}, {"words", "table, of the width"}, {"value", 100 * table_share(solid)}});
    return json;
}

// `design`: of `solid`.
TriedCut tried(const CutGround& ground, const TierDesign& design, Solid solid, std::string done) {
    if (!solid.design) solid.design = std::make_shared<const Design>(drawn_design(solid));
    const Json shown{{"tiers", tiers_json(design, solid)},
                     {"figures", figures_json(solid, merit_options(ground, true))},
                     {"volume", volume(solid)},
                     {"drawings", Json::parse(plain_drawings(solid))["mesh"]},
                     {"note", index_words(ground)}};
    return {mesh_text(solid, MeshFormat::obj), std::move(done), {}, text_of(shown)};
}

}  // namespace

std::string text_of(const TriedCut& cut) {
    return text_of(Json{{"solid", cut.solid},
                        {"done", cut.done},
                        {"optimized", cut.optimized},
                        {"shown", cut.shown}});
}

TriedCut tried_cut_in(const std::string& text) {
    const Json json = Json::parse(text);
    return {json.at("solid"), json.at("done"), json.at("optimized"), json.at("shown")};
}

TriedCut first_cut(const CutGround& ground) {
    const Stone stone = in_export_frame(stone_shown(*ground.loaded, ground.fitted.solid));
    const Solid start = TierDesign(stone.solid).start();
    return tried(ground, TierDesign(start), start, "the stone as it is");
}

TriedCut changed_cut(const CutGround& ground, const std::string& solid_text, std::size_t which,
                     double value) {
    const Solid solid = solid_of(solid_text);
    const TierDesign design(solid);
    const std::vector<CutHandle> handles = handles_of(design, solid);
    if (which >= handles.size() || !std::isfinite(value) || value <= 0)
        throw InputError("the design has no such tier or angle: look again");
    const CutHandle& handle = handles[which];
    const char* const unit = handle.is_height ? "%" : "degrees";
    // Where the whole way loses a meet or a facet, as far as it goes.
    constexpr int k_halvings = 8;
    std::optional<Solid> changed = design.with(turned_to(design, solid, handle, value, 1));
    const bool whole = changed.has_value();
    double least = 0, most = 1;
    for (int i = 0; i < k_halvings && !whole; ++i) {
        const double share = (least + most) / 2;
        std::optional<Solid> nearer = design.with(turned_to(design, solid, handle, value, share));
        (nearer ? least : most) = share;
        if (nearer) changed = std::move(nearer);
    }
    if (!changed)
        throw InputError(
            fmt::format("{} stays at {:.2f} {}: the least change towards {:.2f} loses "
                        "a meet or a facet. Change another tier first, or all of the "
                        "crown or pavilion",
                        handle.name, handle.value, unit, value));
    const TierDesign after(*changed);
    const CutHandle now = handles_of(after, *changed).at(which);
    return tried(ground, after, *changed,
                 fmt::format("{} at {:.2f} {}", handle.name, now.value, unit) +
                     (whole ? "" : fmt::format("; {:.2f} would lose a meet or a facet", value)));
}

TriedCut optimised_cut(const CutGround& ground, const std::string& solid_text,
                       const CutWishes& wishes, const Progress& progress) {
    const Solid solid = solid_of(solid_text);
    OptimizeOptions options;
    options.merit = merit_options(ground, false);
    options.merit.weights = merit_weights(wishes.objective);
    if (wishes.recut) options.recut = Recut{0, wishes.most_loss};
    const Optimized result = optimize_cut(solid, options, progress);
    if (!result.found)
        throw InputError("nothing better was found within 8 degrees: the angles stay as they are");
    const Solid better = about_its_axis(result);
    TriedCut cut =
        tried(ground, TierDesign(better), better,
              fmt::format("{} for {}: {:.1f} -> {:.1f} %", wishes.recut ? "cut anew" : "optimised",
                          wishes.objective, result.at_start.total, result.at_better.total));
    cut.optimized = optimized_json(result, cutting_design(solid), options, wishes.objective);
    return cut;
}

std::string grade_of_cut(const CutGround& ground, const TriedCut& first, const TriedCut& cut,
                         const std::string& version, const Progress& progress) {
    GradeView view;
    view.version = version;
    view.command = "culet studio";
    view.optimized_json = cut.optimized;
    Stone stone = stone_shown(*ground.loaded, {});
    const bool changed = cut.solid != first.solid;
    GradeOptions options;
    constexpr int k_most_tilt = 30, k_step = 5;
    for (int tilt = -k_most_tilt; tilt <= k_most_tilt; tilt += k_step)
        options.tilts.push_back(radians(tilt));
    for (int which = 0; which < (changed ? 2 : 1); ++which) {
        // The pictures take about as long as the figures.
        const Progress part = [&](double done) {
            return !progress || progress((which + done / 2) / (changed ? 2 : 1));
        };
        stone.solid = solid_of(which == 0 ? first.solid : cut.solid);
        const Grade grade = grade_stone(stone.solid, index_of(ground), options, part);
        GradeContext context =
            grade_context(stone.solid, has_material(ground) ? &stone.material : nullptr, options);
        context.name = which == 0 ? "As it is" : "As tried";
        context.notes = {index_words(ground)};
        const std::string json = grade_json(grade, context);
        view.designs.push_back(
            graded_design({stone, has_material(ground), grade, json}, {}, {}, {}));
    }
    return grade_page(view);
}

}  // namespace culet
