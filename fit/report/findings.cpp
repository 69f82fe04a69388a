#include "fit/report/findings.h"

#include "fit/findings/words.h"
#include "fit/report/json_number.h"
#include "stone/design/cut_measures.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

Json axis_json(const OwnAxis& axis) {
    if (!axis.known) return {{"known", false}, {"basis", axis.basis}};
    return {{"known", true},
            {"basis", axis.basis},
            {"direction", {axis.direction.x, axis.direction.y, axis.direction.z}},
            {"tilt", json_degrees(axis.tilt)},
            {"azimuth", json_degrees(axis.azimuth)},
            {"sigma", json_degrees(axis.sigma)},
            {"scatter_sigma", json_degrees(axis.scatter_sigma)}};
}

Json named_tier_json(const NamedTierFinding& tier) {
    const auto odd = [](const OddFacets& o) -> Json {
        return {{"facets", o.facets},
                {"off", json_degrees(o.off)},
                {"sigma", json_degrees(o.sigma)},
                {"p", json_number(o.p)}};
    };
    return {{"tier", tier.name},
            {"words", tier.words},
            {"facets", tier.facets},
            {"read", tier.read},
            {"common", json_degrees(tier.common)},
            {"sigma", json_degrees(tier.sigma)},
            {"spread", json_degrees(tier.spread)},
            {"odd", json_list(tier.odd, odd)},
            {"what", tier.what}};
}

Json meet_json(const MeetFinding& meet) {
    Json json{{"facets", meet.facets},
              {"how", meet.how},
              {"miss", json_number(meet.miss)},
              {"sigma", json_number(meet.sigma)},
              {"chi2", json_number(meet.chi2)},
              {"conditions", meet.conditions},
              {"tested", meet.tested},
              {"p", json_number(meet.p)},
              {"contradicted", meet.contradicted}};
    if (!meet.advice.empty()) json["advice"] = meet.advice;
    return json;
}

Json shape_json(const ShapeFinding& finding) {
    return {{"kind", name_of(finding.kind)},       {"facets", finding.facets},
            {"value", json_number(finding.value)}, {"sigma", json_number(finding.sigma)},
            {"p", json_number(finding.p)},         {"what", finding.what}};
}

Json group_json(const GroupTest& g) {
    return {{"group", g.group},
            {"mirror_azimuth", g.mirrors ? json_degrees(g.mirror_azimuth) : Json()},
            {"conditions", g.conditions},
            {"tested", g.tested},
            {"chi2", json_number(g.chi2)},
            {"p", json_number(g.p)},
            {"supported", g.supported},
            {"determined", g.determined}};
}

Json symmetric_tier_json(const TierSymmetry& t) {
    return {{"tier", t.tier},
            {"facets", t.facets},
            {"deviation", json_degrees(t.deviation)},
            {"sigma", json_degrees(t.sigma)},
            {"sigma_sigma", json_degrees(t.sigma_sigma)},
            {"at_most", json_degrees(t.at_most)},
            {"p", json_number(t.p)},
            {"worst", t.worst},
            {"worst_off", json_degrees(t.worst_off)}};
}

Json symmetry_json(const SymmetryReport& symmetry) {
    return {{"form", symmetry.form},
            {"proposed", symmetry.proposed},
            {"message", symmetry.message},
            {"sigma", json_degrees(symmetry.sigma)},
            {"sigma_sigma", json_degrees(symmetry.sigma_sigma)},
            {"readings", symmetry.readings},
            {"groups", json_list(symmetry.groups, group_json)},
            {"tiers", json_list(symmetry.tiers, symmetric_tier_json)}};
}

Json proposal_json(const Proposal& p) {
    const double unit = p.in_radians ? degrees(1) : 1;
    Json json{{"id", p.id},
              {"estimate", json_number(unit * p.estimate)},
              {"sigma", json_number(unit * p.sigma)}};
    if (!p.slip.empty()) {
        json["slip"] = p.slip;
        json["corrected"] = json_number(unit * p.corrected);
    }
    json["alternatives"] = p.alternatives;
    return json;
}

Json proportion_json(const FittedProportion& p) {
    Json json{{"name", p.name},
              {"value", json_number(p.value)},
              {"sigma", json_number(p.sigma)},
              {"unit", p.unit}};
    for (const auto& [key, style] :
         {std::pair("gia", ReportStyle::gia), std::pair("ags", ReportStyle::ags)}) {
        const double step = rounding_step(style, p.name, p.unit);
        if (step > 0) json[key] = json_number(rounded_to(p.value, step));
    }
    return json;
}

Json help_json(const NextReading& h) {
    return {{"kind", name_of(h.kind)},
            {"of", h.of},
            {"sigma", json_number(file_unit(h.kind) * h.sigma)},
            {"reduces", json_number(h.reduces)},
            {"closes", h.closes}};
}

Json undetermined_json(const Undetermined& u) {
    return {{"facet", u.facet}, {"freedom", u.freedom}};
}

// Findings that are there only if asked for.
void add_stones_own(const FitResult& result, Json& report) {
    const FitFindings& findings = result.findings;
    for (std::size_t f = 0; f < result.facets.size(); ++f) {
        report["facets"][f]["inclination_own_axis"] =
            json_degrees(result.facets[f].inclination_own_axis);
    }
    report["own_axis"] = axis_json(findings.own_axis);
    const auto name = [&](int f) { return result.facets[std::size_t(f)].name; };
    report["tiers"] = json_list(findings.tiers, [&](const Tier& tier) -> Json {
        return {{"name", tier.name},
                {"facets", json_list(tier.facets, name)},
                {"inclination", json_degrees(tier.mean)},
                {"spread", json_degrees(tier.spread)},
                {"inclination_own_axis", json_degrees(tier.mean_own_axis)},
                {"spread_own_axis", json_degrees(tier.spread_own_axis)},
                {"rms_own_axis", json_degrees(tier.rms_own_axis)}};
    });
    report["meets"]["list"] = json_list(findings.meets, meet_json);
    Json& proposals = report["meets"]["proposals"] = Json::array();
    for (const MeetFinding& meet : findings.meets) {
        if (meet.contradicted) proposals.push_back(meet.advice);
    }
    report["shape"] = json_list(findings.shapes, shape_json);
    report["changes"] = result.log.changes;
    report["changed"] = result.log.changed;
    if (findings.symmetry) report["symmetry"] = symmetry_json(*findings.symmetry);
}

}  // namespace

void add_findings(const FitResult& result, Json& report) {
    const FitFindings& findings = result.findings;
    report["undetermined"] = json_list(findings.undetermined, undetermined_json);
    report["undetermined_words"] = findings.undetermined_words;
    report["doubts"] = findings.doubts;
    report["suspects"] = findings.suspects;
    report["proposals"] = json_list(findings.proposals, proposal_json);
    report["disagreeing"] = findings.disagreeing;
    report["vanishing_edges"] = findings.vanishing_edges;
    report["tier_angles"] = json_list(findings.named_tiers, named_tier_json);
    report["proportions"] = json_list(findings.proportions, proportion_json);
    report["help"] = json_list(findings.help, help_json);
    if (result.log.options.findings) add_stones_own(result, report);
}

}  // namespace culet
