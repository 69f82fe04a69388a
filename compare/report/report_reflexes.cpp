// Report section that draws the bright reflexes over both pictures.

#include <fmt/format.h>

#include <algorithm>

#include "compare/report/report_parts.h"
#include "compare/templates.h"
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
    const auto px = [](double value) { return fmt::format("{:.1f}", value); };
    std::vector<View> rings;
    for (const ReflexCount::Mark& mark : marks) {
        const bool found = mark.partner >= 0;
        // Each line is drawn once, from the photo's side.
        const bool apart = found && mark.of_photo;
        const auto& other =
            apart ? marks[first_of_render + static_cast<std::size_t>(mark.partner)] : mark;
        rings.push_back({{"apart", apart},
                         {"x", px(mark.at_px[0] + 0.5)},
                         {"y", px(mark.at_px[1] + 0.5)},
                         {"to_x", px(other.at_px[0] + 0.5)},
                         {"to_y", px(other.at_px[1] + 0.5)},
                         {"whose", mark.of_photo ? "in-photo" : "in-render"},
                         {"found", found ? "found" : "alone"},
                         {"radius", px(std::max(2.5, mark.radius_px + 1))}});
    }
    const auto side = [&](const Photo& picture, const std::string& what) {
        return View{{"width", std::to_string(picture.width)},
                    {"height", std::to_string(picture.height)},
                    {"what", what},
                    {"uri", picture_uri(picture, white_shown(c))},
                    {"marks", rings}};
    };
    const std::vector<View> sides{side(photo, "Reflexes over the " + word),
                                  side(c.pictures.render, "The same over the render")};
    const std::string body =
        filled(templates::report_reflexes,
               {{"sentence", sentence_of(c.reflexes)}, {"sides", sides}, {"word", word}});
    return section("reflexes", "Reflexes", body);
}

}  // namespace culet
