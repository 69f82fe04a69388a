#include "page/certificate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "stone/cuts/cuts.h"
#include "tests/page/kept_pages.h"

namespace culet {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

Json proportion(const char* name, double value, double sigma, const char* unit) {
    return {{"name", name}, {"value", value}, {"sigma", sigma}, {"unit", unit}};
}

Json fit_of_brilliant() {
    return {
        {"status", "converged"},
        {"proportions",
         {proportion("diameter", 6.478, 0.0075, "mm"),
          proportion("caliper min", 6.390, 0.019, "mm"),
          proportion("caliper max", 6.525, 0.012, "mm"), proportion("depth", 3.986, 0.010, "mm"),
          proportion("total depth", 61.52, 0.18, "%"), proportion("table", 58.43, 0.38, "%"),
          proportion("crown height", 14.12, 0.17, "%"),
          proportion("girdle thickness", 3.40, 0.20, "%"),
          proportion("pavilion depth", 44.01, 0.12, "%"),
          proportion("crown angle", 33.799, 0.035, "deg"),
          proportion("pavilion angle", 41.220, 0.035, "deg"),
          proportion("volume", 58.46, 0.26, "mm3"), proportion("weight", 1.0289, 0.0045, "ct")}},
        {"readings", {{{"id", "r0"}, {"kind", "weight"}, {"value", 1.03}, {"sigma", 0.005}}}},
        {"suspects", Json::array()}};
}

Certificate certificate_of(const Json& fit) {
    Certificate certificate;
    certificate.name = "Round brilliant";
    certificate.stone = make_cut("round-brilliant");
    certificate.fit_json = fit.dump();
    return certificate;
}

TEST(Certificate, StatesTheFiguresOfTheFitWithTheirUncertainties) {
    const std::string page = certificate_page(certificate_of(fit_of_brilliant()));
    for (const char* shown :
         {"6.39\u2009–\u20096.53 × 3.99\u00a0mm", "6.4780 ± 0.0075\u00a0mm", "33.799 ± 0.035°",
          "41.220 ± 0.035°", "58.43 ± 0.38\u00a0%", "1.0300 ± 0.0050\u00a0ct <small>weighed"})
        EXPECT_THAT(page, HasSubstr(shown));
    // Nothing that was not given.
    for (const char* other : {"No. ", "Material</dt>", "<img", "Not to be relied on"})
        EXPECT_THAT(page, Not(HasSubstr(other)));
}

TEST(Certificate, TakesTheWeightOfTheFitWhereTheBalanceIsInDoubt) {
    Json fit = fit_of_brilliant();
    fit["suspects"] = {"r0"};
    EXPECT_THAT(certificate_page(certificate_of(fit)),
                HasSubstr("1.0289 ± 0.0045\u00a0ct <small>calculated"));
    fit["proportions"].erase(fit["proportions"].size() - 1);
    EXPECT_THAT(certificate_page(certificate_of(fit)), Not(HasSubstr("Weight")));
}

TEST(Certificate, SaysThatADoubtfulFitIsNotToBeReliedOn) {
    EXPECT_THAT(certificate_page(certificate_of({{"status", "not_converged"}})),
                HasSubstr("Not to be relied on: the fit to the readings is not converged"));
}

TEST(Certificate, EscapesForeignTextAndLoadsNothing) {
    Json doubtful = fit_of_brilliant();
    doubtful["status"] = "contradictory";
    Certificate certificate = certificate_of(doubtful);
    certificate.picture_png = "as tall as any picture";
    certificate.name = certificate.material = certificate.issuer = certificate.number =
        certificate.date = test::hostile_name();
    certificate.logo_uri = logo_uri("<svg xmlns='http://www.w3.org/2000/svg'/>");
    const std::string page = certificate_page(certificate);
    EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(page, Not(HasSubstr("http:")));
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
    test::keep_page("certificate", page);
    certificate.paper = "letter";
    test::keep_page("certificate-letter", certificate_page(certificate));
}

TEST(Certificate, TakesPngJpegAndSvgAsLogo) {
    EXPECT_EQ(logo_uri("\x89PNG\r\n"), "data:image/png;base64,iVBORw0K");
    EXPECT_THAT(logo_uri("\xff\xd8\xff\xe0"), HasSubstr("data:image/jpeg;base64,/9j/4A=="));
    EXPECT_THAT(logo_uri("<?xml version='1.0'?><svg/>"), HasSubstr("data:image/svg+xml;base64,"));
    for (const char* other : {"", "GIF89a", "<html></html>"}) EXPECT_EQ(logo_uri(other), "");
}

}  // namespace
}  // namespace culet
