#include "fit/report/findings.h"

#include "fit/report/json_number.h"
#include "stone/units.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Json axis_of(const OwnAxis& axis) {
    if (!axis.known) return {{"known", false}, {"basis", axis.basis}};
    return {{"known", true},
            {"basis", axis.basis},
            {"direction", {axis.direction.x, axis.direction.y, axis.direction.z}},
            {"tilt", degrees(axis.tilt)},
            {"azimuth", degrees(axis.azimuth)},
            {"sigma", json_number(degrees(axis.sigma))},
            {"scatter_sigma", json_number(degrees(axis.scatter_sigma))}};
}

Json symmetry_of(const SymmetryReport& symmetry) {
    Json groups = Json::array(), tiers = Json::array();
    for (const GroupTest& g : symmetry.groups) {
        groups.push_back({{"group", g.group},
                          {"mirror_azimuth", g.mirrors ? Json(degrees(g.mirror_azimuth)) : Json()},
                          {"conditions", g.conditions},
                          {"tested", g.tested},
                          {"chi2", json_number(g.chi2)},
                          {"p", json_number(g.p)},
                          {"supported", g.supported},
                          {"determined", g.determined}});
    }
    for (const TierSymmetry& t : symmetry.tiers) {
        tiers.push_back({{"tier", t.tier},
                         {"facets", t.facets},
                         {"deviation", json_number(degrees(t.deviation))},
                         {"sigma", json_number(degrees(t.sigma))},
                         {"sigma_sigma", json_number(degrees(t.sigma_sigma))},
                         {"at_most", json_number(degrees(t.at_most))},
                         {"p", json_number(t.p)},
                         {"worst", t.worst},
                         {"worst_off", json_number(degrees(t.worst_off))}});
    }
    return {{"form", symmetry.form},
            {"proposed", symmetry.proposed},
            {"message", symmetry.message},
            {"sigma", json_number(degrees(symmetry.sigma))},
            {"sigma_sigma", json_number(degrees(symmetry.sigma_sigma))},
            {"readings", symmetry.readings},
            {"groups", groups},
            {"tiers", tiers}};
}

}  // namespace

void add_findings(const FitResult& result, Json& report) {
    if (!result.log.options.findings) return;
    Json& facets = report["facets"];
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        facets[f]["inclination_own_axis"] =
            json_number(degrees(result.facets[f].inclination_own_axis));
    }
    report["own_axis"] = axis_of(result.findings.own_axis);
    Json tiers = Json::array();
    for (const Tier& tier : result.findings.tiers) {
        Json names = Json::array();
        for (int f : tier.facets) names.push_back(result.facets[std::size_t(f)].name);
        tiers.push_back({{"name", tier.name},
                         {"facets", names},
                         {"inclination", json_number(degrees(tier.mean))},
                         {"spread", json_number(degrees(tier.spread))},
                         {"inclination_own_axis", json_number(degrees(tier.mean_own_axis))},
                         {"spread_own_axis", json_number(degrees(tier.spread_own_axis))},
                         {"rms_own_axis", json_number(degrees(tier.rms_own_axis))}});
    }
    report["tiers"] = tiers;
    Json meets = Json::array(), proposals = Json::array();
    for (const MeetFinding& meet : result.findings.meets) {
        meets.push_back({{"facets", meet.facets},
                         {"how", meet.how},
                         {"miss", json_number(meet.miss)},
                         {"sigma", json_number(meet.sigma)},
                         {"chi2", json_number(meet.chi2)},
                         {"conditions", meet.conditions},
                         {"tested", meet.tested},
                         {"p", json_number(meet.p)},
                         {"contradicted", meet.contradicted}});
        if (!meet.advice.empty()) meets.back()["advice"] = meet.advice;
        if (meet.contradicted) proposals.push_back(meet.advice);
    }
    report["meets"]["list"] = meets;
    report["meets"]["proposals"] = proposals;
    Json shape = Json::array();
    for (const ShapeFinding& finding : result.findings.shapes) {
        shape.push_back({{"kind", name_of(finding.kind)},
                         {"facets", finding.facets},
                         {"value", json_number(finding.value)},
                         {"sigma", json_number(finding.sigma)},
                         {"p", json_number(finding.p)},
                         {"what", finding.what}});
    }
    report["shape"] = shape;
    report["changes"] = result.log.changes;
    report["changed"] = result.log.changed;
    if (result.findings.symmetry) report["symmetry"] = symmetry_of(*result.findings.symmetry);
}

}  // namespace culet
