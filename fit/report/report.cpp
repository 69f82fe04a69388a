// The fit report: the keys of docs/fit-report.md, and a few more.

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "fit/findings/result.h"
#include "fit/findings/summary.h"
#include "fit/findings/words.h"
#include "fit/report/findings.h"
#include "fit/report/json_number.h"
#include "stone/design/design.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Json prior_json(const PriorReport& prior) {
    Json json{{"source", name_of(prior.source)}};
    if (prior.source == Prior::Source::none) return json;
    json["tier_angle"] = degrees(prior.tier_angle);
    json["facet_angle"] = degrees(prior.facet_angle);
    json["tier_offset"] = prior.tier_offset;
    json["facet_offset"] = prior.facet_offset;
    return json;
}

// Tier and index setting in the design that the stone was cut by, if known.
void add_design(const Design& design, const std::string& facet, Json& json) {
    const std::vector<std::string> titles = tier_titles(design);
    for (std::size_t t = 0; t < titles.size(); ++t) {
        for (const DesignFacet& own : design.tiers[t].facets) {
            if (own.facet != facet) continue;
            json["tier"] = titles[t];
            json["index"] = own.index;
        }
    }
}

Json facets_json(const std::vector<FittedFacet>& facets, const Design* design) {
    Json json = Json::array();
    for (const FittedFacet& f : facets) {
        const Vec3& n = f.plane.normal;
        json.push_back({{"name", f.name},
                        {"normal", {n.x, n.y, n.z}},
                        {"offset", f.plane.offset},
                        {"inclination", degrees(f.inclination)},
                        {"azimuth", degrees(f.azimuth)},
                        {"sigma_inclination", json_degrees(f.sigma_inclination)},
                        {"sigma_azimuth", json_degrees(f.sigma_azimuth)},
                        {"sigma_offset", json_number(f.sigma_offset)},
                        {"from_readings",
                         {{"inclination", json_number(f.read_inclination)},
                          {"azimuth", json_number(f.read_azimuth)},
                          {"offset", json_number(f.read_offset)}}},
                        {"area", f.area},
                        {"sigma_area", json_number(f.sigma_area)}});
        if (design != nullptr) add_design(*design, f.name, json.back());
    }
    return json;
}

Json misfit_json(const SilhouetteMisfit& misfit) {
    return {{"rms", json_number(misfit.rms)},
            {"worst", json_number(misfit.worst)},
            {"points", misfit.points},
            {"outliers", misfit.outliers},
            {"contours", misfit.contours}};
}

void add_silhouette(const SilhouetteFinding& finding, Json& reading) {
    reading.update(misfit_json(finding.misfit));
    reading["sigma"] = json_number(finding.sigma);
    reading["sigma_estimated"] = finding.estimated;
    if (finding.held_out) reading["held_out"] = misfit_json(*finding.held_out);
}

void add_photograph(const PhotographFinding& finding, Json& reading) {
    reading["rms_before"] = json_number(finding.rms_before);
    reading["rms"] = json_number(finding.rms);
    reading["moves_told"] = json_number(finding.parameters_determined);
    reading["contradictions"] =
        json_list(finding.contradictions, [](const PhotographFinding::Place& place) -> Json {
            return {{"x", json_number(place.x)},
                    {"y", json_number(place.y)},
                    {"facet", place.facet},
                    {"photograph_is", place.brighter ? "brighter" : "darker"},
                    {"deviations", json_number(place.deviations)},
                    {"area", json_number(place.area)}};
        });
}

Json readings_json(const std::vector<FittedReading>& readings, bool is_weighted) {
    Json json = Json::array();
    for (const FittedReading& r : readings) {
        const double unit = file_unit(r.kind);
        json.push_back(
            {{"id", r.id},
             {"kind", name_of(r.kind)},
             {"of", r.of},
             {"value", is_relation(r.kind) ? Json(nullptr) : json_number(unit * r.value)},
             {"sigma", json_number(unit * r.sigma)},
             {"exact", r.exact},
             {"fitted", json_number(unit * r.fitted)},
             {"residual", json_number(unit * r.residual)},
             {"normalized", json_number(r.normalized)},
             {"redundancy", json_number(r.redundancy)},
             {"detectable", r.detectable > 0 ? json_number(unit * r.detectable) : Json(nullptr)},
             {"suspect", r.suspect}});
        if (r.line) {
            json.back().update({{"points", r.line->points},
                                {"rms", json_number(r.line->rms)},
                                {"worst", json_number(r.line->worst)},
                                {"worst_point", {r.line->u, r.line->v}}});
        }
        if (r.silhouette) add_silhouette(*r.silhouette, json.back());
        if (r.photograph) add_photograph(*r.photograph, json.back());
        if (!r.left_out.empty()) json.back()["left_out"] = r.left_out;
        if (r.rounding > 0) json.back()["rounding"] = json_number(unit * r.rounding);
        if (is_weighted) json.back()["weight"] = json_number(r.weight);
    }
    return json;
}

Json meets_json(const MeetReport& meets) {
    return {{"exact", meets.exact},
            {"soft", meets.soft},
            {"released", meets.released},
            {"sigma", meets.sigma},
            {"girdle_sigma", meets.girdle_sigma},
            {"sigma_estimated", meets.estimated},
            {"sigma_ends", meets.local_maxima},
            {"miss_rms", meets.miss_rms},
            {"miss_max", meets.miss_max}};
}

Json options_json(const FitOptions& options) {
    return {{"meets", name_of(options.meets)},
            {"meet_sigma", options.meet_sigma ? Json(*options.meet_sigma) : Json("auto")},
            {"iterations", options.iterations},
            {"significance", options.significance},
            {"loss", name_of(options.loss)}};
}

// Placeholder for the covariance, which is written one row a line.
constexpr std::string_view k_covariance_here = "\"facet covariance goes here\"";

// Degrees and the stone's unit. Six digits: a millionth of a sigma.
std::string covariance_rows(const std::vector<double>& covariance) {
    const auto size = static_cast<std::size_t>(std::lround(std::sqrt(covariance.size())));
    const auto unit = [](std::size_t i) { return i % 3 == 2 ? 1 : degrees(1); };
    std::string rows = "[";
    for (std::size_t i = 0; i < size; ++i) {
        rows += i == 0 ? "\n  [" : ",\n  [";
        for (std::size_t j = 0; j < size; ++j) {
            const double value = covariance[i * size + j] * unit(i) * unit(j);
            if (j > 0) rows += ", ";
            rows += std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
        }
        rows += "]";
    }
    return rows + (size > 0 ? "\n ]" : "]");
}

}  // namespace

std::string fit_report(const FitResult& result) {
    Json report;
    report["schema"] = 1;
    report["status"] = name_of(result.status);
    report["message"] = result.message;
    report["summary"] = fit_summary(result);
    report["unit"] = std::string(name_of(result.unit));
    report["facets"] = facets_json(result.facets, result.solid.design.get());
    Json areas = Json::object();
    for (const FittedFacet& f : result.facets) areas[f.name] = f.area;
    report["areas"] = areas;
    report["readings"] = readings_json(result.readings, result.log.options.loss != Loss::none);
    report["undetermined_freedoms"] = result.statistics.rank_defect;
    report["suspect_limit"] = result.statistics.suspect_limit;
    report["missing_facets"] = result.checks.missing_facets;
    report["starts"] = result.log.starts;
    report["start"] = result.log.start;
    report["notes"] = result.log.notes;
    report["meets"] = meets_json(result.statistics.meets);
    report["prior"] = prior_json(result.statistics.prior);
    add_findings(result, report);
    report["planarity_max"] = result.checks.planarity_max;
    report["closed"] = result.checks.closed;
    report["convex"] = result.checks.convex;
    report["chi2"] = json_number(result.statistics.chi2);
    report["dof"] = json_number(result.statistics.dof);
    report["chi2_limit"] = json_number(result.statistics.chi2_limit);
    report["chi2_p"] = json_number(result.statistics.chi2_p);
    report["chi2_low_p"] = json_number(result.statistics.chi2_low_p);
    report["azimuth_zero"] = degrees(result.azimuth_zero);
    report["iterations"] = result.log.iterations;
    report["seconds"] = result.log.seconds;
    report["options"] = options_json(result.log.options);
    report["facet_covariance"] = k_covariance_here.substr(1, k_covariance_here.size() - 2);
    std::string text = report.dump(1) + "\n";
    return text.replace(text.rfind(k_covariance_here), k_covariance_here.size(),
                        covariance_rows(result.facet_covariance));
}

}  // namespace culet
