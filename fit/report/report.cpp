// The fit report: the keys of docs/stone-files.md, and a few more.

#include "fit/findings/result.h"
#include "fit/findings/summary.h"
#include "fit/report/assessment.h"
#include "fit/report/findings.h"
#include "fit/report/json_number.h"
#include "stone/units.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity and no NaN.
bool in_degrees(ReadingKind kind) {
    return is_angle(kind) || kind == ReadingKind::parallel || kind == ReadingKind::rotation ||
           kind == ReadingKind::mirror;
}

Json prior_json(const PriorReport& prior) {
    Json json{{"source", name_of(prior.source)}};
    if (prior.source == Prior::Source::none) return json;
    json["tier_angle"] = degrees(prior.tier_angle);
    json["facet_angle"] = degrees(prior.facet_angle);
    json["tier_offset"] = prior.tier_offset;
    json["facet_offset"] = prior.facet_offset;
    return json;
}

Json tier_angles(const FitResult& result) {
    Json tiers = Json::array();
    for (const NamedTierFinding& tier : result.findings.named_tiers) {
        Json odd = Json::array();
        for (const OddFacets& o : tier.odd) {
            odd.push_back({{"facets", o.facets},
                           {"off", degrees(o.off)},
                           {"sigma", degrees(o.sigma)},
                           {"p", json_number(o.p)}});
        }
        tiers.push_back({{"tier", tier.name},
                         {"words", tier.words},
                         {"facets", tier.facets},
                         {"read", tier.read},
                         {"common", degrees(tier.common)},
                         {"sigma", degrees(tier.sigma)},
                         {"spread", degrees(tier.spread)},
                         {"odd", odd},
                         {"what", tier.what}});
    }
    return tiers;
}

}  // namespace

const char* name_of(MeetTreatment treatment) {
    switch (treatment) {
        case MeetTreatment::exact:
            return "exact";
        case MeetTreatment::soft:
            return "soft";
        case MeetTreatment::released:
            return "released";
    }
    return "exact";
}

std::string fit_report(const FitResult& result) {
    Json report;
    report["schema"] = 1;
    report["status"] = name_of(result.status);
    report["message"] = result.message;
    report["summary"] = fit_summary(result);
    report["unit"] = std::string(name_of(result.unit));
    Json facets = Json::array();
    for (const FittedFacet& f : result.facets) {
        const Vec3& n = f.plane.normal;
        facets.push_back({{"name", f.name},
                          {"normal", {n.x, n.y, n.z}},
                          {"offset", f.plane.offset},
                          {"inclination", degrees(f.inclination)},
                          {"azimuth", degrees(f.azimuth)},
                          {"sigma_inclination", json_number(degrees(f.sigma_inclination))},
                          {"sigma_azimuth", json_number(degrees(f.sigma_azimuth))},
                          {"sigma_offset", json_number(f.sigma_offset)},
                          {"from_readings",
                           {{"inclination", json_number(f.read_inclination)},
                            {"azimuth", json_number(f.read_azimuth)},
                            {"offset", json_number(f.read_offset)}}},
                          {"area", f.area},
                          {"sigma_area", json_number(f.sigma_area)}});
    }
    report["facets"] = facets;
    Json areas = Json::object();
    for (const FittedFacet& f : result.facets) areas[f.name] = f.area;
    report["areas"] = areas;
    Json readings = Json::array();
    for (const FittedReading& r : result.readings) {
        const double unit = in_degrees(r.kind) ? degrees(1) : 1;
        readings.push_back(
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
        if (!r.left_out.empty()) readings.back()["left_out"] = r.left_out;
        if (r.rounding > 0) readings.back()["rounding"] = json_number(unit * r.rounding);
    }
    report["readings"] = readings;
    Json undetermined = Json::array();
    for (const Undetermined& u : result.findings.undetermined) {
        undetermined.push_back({{"facet", u.facet}, {"freedom", u.freedom}});
    }
    report["undetermined"] = undetermined;
    report["undetermined_freedoms"] = result.statistics.rank_defect;
    report["doubts"] = result.findings.doubts;
    report["suspects"] = result.findings.suspects;
    report["suspect_limit"] = result.statistics.suspect_limit;
    report["missing_facets"] = result.checks.missing_facets;
    report["vanishing_edges"] = result.findings.vanishing_edges;
    report["starts"] = result.log.starts;
    report["start"] = result.log.start;
    report["notes"] = result.log.notes;
    report["meets"] = {{"exact", result.statistics.meets.exact},
                       {"soft", result.statistics.meets.soft},
                       {"released", result.statistics.meets.released},
                       {"sigma", result.statistics.meets.sigma},
                       {"girdle_sigma", result.statistics.meets.girdle_sigma},
                       {"sigma_estimated", result.statistics.meets.estimated},
                       {"sigma_ends", result.statistics.meets.ends},
                       {"miss_rms", result.statistics.meets.miss_rms},
                       {"miss_max", result.statistics.meets.miss_max}};
    report["prior"] = prior_json(result.statistics.prior);
    report["tier_angles"] = tier_angles(result);
    add_findings(result, report);
    report["planarity_max"] = result.checks.planarity_max;
    report["closed"] = result.checks.closed;
    report["convex"] = result.checks.convex;
    report["chi2"] = json_number(result.statistics.chi2);
    report["dof"] = json_number(result.statistics.dof);
    report["chi2_limit"] = json_number(result.statistics.chi2_limit);
    report["chi2_p"] = json_number(result.statistics.chi2_p);
    report["azimuth_zero"] = degrees(result.azimuth_zero);
    report["iterations"] = result.log.iterations;
    report["seconds"] = result.log.seconds;
    report["options"] = {
        {"meets", name_of(result.log.options.meets)},
        {"meet_sigma",
         result.log.options.meet_sigma ? Json(*result.log.options.meet_sigma) : Json("auto")},
        {"iterations", result.log.options.iterations},
        {"significance", result.log.options.significance}};
    report_assessment(result, report);
    return report.dump(1) + "\n";
}

}  // namespace culet
