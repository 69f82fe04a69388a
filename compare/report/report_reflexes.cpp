// The section of the report that draws the bright reflexes over both pictures.

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/report/report_parts.h"
#include "page/html.h"
#include "page/parts.h"

namespace culet {

std::string reflexes_section(const Report& report) {
    if (!report.comparison || report.comparison->reflexes.marks.empty()) return {};
    const Comparison& c = *report.comparison;
    const Photo& photo = c.pictures.photo;
    if (photo.rgb.empty()) return {};
    const std::string word = photo_word(report);
    const auto& marks = c.reflexes.marks;
    const std::size_t first_of_render = static_cast<std::size_t>(c.reflexes.in_photo);
    std::string shapes;
    for (const ReflexCount::Mark& mark : marks) {
        const bool found = mark.partner >= 0;
        // Lines are drawn once, from the photo's side.
        if (found && mark.of_photo) {
            const auto& other = marks[first_of_render + static_cast<std::size_t>(mark.partner)];
            shapes += fmt::format(
                "<line class=\"apart\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
                mark.at_px[0] + 0.5, mark.at_px[1] + 0.5, other.at_px[0] + 0.5,
                other.at_px[1] + 0.5);
        }
        shapes += fmt::format("<circle class=\"{} {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>",
                              mark.of_photo ? "in-photo" : "in-render", found ? "found" : "alone",
                              mark.at_px[0] + 0.5, mark.at_px[1] + 0.5,
                              std::max(2.5, mark.radius_px + 1));
    }
    const auto side = [&](const Photo& picture, const std::string& what) {
        return fmt::format(
            "<figure class=\"overlay reflexes\"><svg viewBox=\"0 0 {0} {1}\" role=\"img\" "
            "aria-label=\"{2}\"><image href=\"{3}\" width=\"{0}\" height=\"{1}\"/>{4}</svg>"
            "<figcaption>{2}</figcaption></figure>\n",
            picture.width, picture.height, escaped(what), picture_uri(picture, white_shown(c)),
            shapes);
    };
    std::string body =
        fmt::format("<p>{}.</p>\n<div class=\"reflex-pair\">\n", escaped(sentence_of(c.reflexes)));
    body += side(photo, "Reflexes over the " + word) +
            side(c.pictures.render, "The same over the render");
    body += fmt::format(
        "</div>\n<p class=\"note\"><span class=\"key-ring found\"></span>found in both "
        "<span class=\"key-ring photo-alone\"></span>in the {} only "
        "<span class=\"key-ring render-alone\"></span>in the render only. Rings have the reflexes' "
        "areas; a reflex is what is brighter than nine tenths of the {}.</p>\n",
        word, word);
    return section("reflexes", "Reflexes", body);
}

}  // namespace culet
