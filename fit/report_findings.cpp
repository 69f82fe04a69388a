#include "fit/report_findings.h"

#include <cmath>

#include "stone/units.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json axis_of(const OwnAxis& axis) {
    if (!axis.known) return {{"known", false}, {"basis", axis.basis}};
    return {{"known", true},
            {"basis", axis.basis},
            {"direction", {axis.direction.x, axis.direction.y, axis.direction.z}},
            {"tilt", degrees(axis.tilt)},
            {"azimuth", degrees(axis.azimuth)},
            {"sigma", number(degrees(axis.sigma))},
            {"scatter_sigma", number(degrees(axis.scatter_sigma))}};
}

Json symmetry_of(const SymmetryReport& symmetry) {
    Json groups = Json::array(), tiers = Json::array();
    for (const GroupTest& g : symmetry.groups) {
        groups.push_back({{"group", g.group},
                          {"mirror_azimuth", g.mirrors ? Json(degrees(g.mirror_azimuth)) : Json()},
                          {"conditions", g.conditions},
                          {"tested", g.tested},
                          {"chi2", number(g.chi2)},
                          {"p", number(g.p)},
                          {"supported", g.supported},
                          {"determined", g.determined}});
    }
    for (const TierSymmetry& t : symmetry.tiers) {
        tiers.push_back({{"tier", t.tier},
                         {"facets", t.facets},
                         {"deviation", number(degrees(t.deviation))},
                         {"sigma", number(degrees(t.sigma))},
                         {"sigma_sigma", number(degrees(t.sigma_sigma))},
                         {"at_most", number(degrees(t.at_most))},
                         {"p", number(t.p)},
                         {"worst", t.worst},
                         {"worst_off", number(degrees(t.worst_off))}});
    }
    return {{"form", symmetry.form},
            {"proposed", symmetry.proposed},
            {"message", symmetry.message},
            {"sigma", number(degrees(symmetry.sigma))},
            {"sigma_sigma", number(degrees(symmetry.sigma_sigma))},
            {"readings", symmetry.readings},
            {"groups", groups},
            {"tiers", tiers}};
}

}  // namespace

void add_findings(const FitResult& result, Json& report) {
    if (!result.options.findings) return;
    Json& facets = report["facets"];
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        facets[f]["inclination_own_axis"] = number(degrees(result.facets[f].inclination_own_axis));
    }
    report["own_axis"] = axis_of(result.own_axis);
    Json tiers = Json::array();
    for (const Tier& tier : result.tiers) {
        Json names = Json::array();
        for (int f : tier.facets) names.push_back(result.facets[std::size_t(f)].name);
        tiers.push_back({{"name", tier.name},
                         {"facets", names},
                         {"inclination", number(degrees(tier.mean))},
                         {"spread", number(degrees(tier.spread))},
                         {"inclination_own_axis", number(degrees(tier.mean_own_axis))},
                         {"spread_own_axis", number(degrees(tier.spread_own_axis))},
                         {"rms_own_axis", number(degrees(tier.rms_own_axis))}});
    }
    report["tiers"] = tiers;
    Json meets = Json::array(), proposals = Json::array();
    for (const MeetFinding& meet : result.meet_findings) {
        meets.push_back({{"facets", meet.facets},
                         {"how", meet.how},
                         {"miss", number(meet.miss)},
                         {"sigma", number(meet.sigma)},
                         {"chi2", number(meet.chi2)},
                         {"conditions", meet.conditions},
                         {"tested", meet.tested},
                         {"p", number(meet.p)},
                         {"contradicted", meet.contradicted}});
        if (!meet.advice.empty()) meets.back()["advice"] = meet.advice;
        if (meet.contradicted) proposals.push_back(meet.advice);
    }
    report["meets"]["list"] = meets;
    report["meets"]["proposals"] = proposals;
    Json shape = Json::array();
    for (const ShapeFinding& finding : result.shape_findings) {
        const double unit = finding.kind == ShapeFinding::Kind::same_plane ? degrees(1) : 1;
        shape.push_back({{"kind", name_of(finding.kind)},
                         {"facets", finding.facets},
                         {"value", number(unit * finding.value)},
                         {"sigma", number(unit * finding.sigma)},
                         {"p", number(finding.p)},
                         {"what", finding.what}});
    }
    report["shape"] = shape;
    Json extra = Json::array();
    for (const ExtraFacet& facet : result.extra_facets) {
        extra.push_back({{"at", facet.at},
                         {"depth", number(facet.depth)},
                         {"sigma", number(facet.sigma)},
                         {"chi2", number(facet.chi2)},
                         {"p", number(facet.p)},
                         {"shown_by", facet.shown_by},
                         {"what", facet.what}});
        if (!facet.or_wrong.empty()) extra.back()["or_wrong"] = facet.or_wrong;
    }
    report["extra_facets"] = extra;
    report["changes"] = result.changes;
    if (result.symmetry) report["symmetry"] = symmetry_of(*result.symmetry);
}

}  // namespace culet
