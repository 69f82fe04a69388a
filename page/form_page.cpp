#include "page/form_page.h"

#include <fmt/format.h>

#include "page/drawing.h"
#include "page/parts.h"
#include "page/template.h"
#include "page/templates.h"

namespace culet {

std::string form_page(const PrintedForm& form) {
    std::vector<View> views, rows;
    for (const ViewSide side : {ViewSide::crown, ViewSide::pavilion}) {
        std::string svg = draw_facets_svg(form.solid, side);
        if (svg.empty()) continue;
        views.push_back({{"drawing_svg", std::move(svg)}, {"caption", caption_of(side)}});
    }
    for (const PrintedForm::Row& row : form.rows) {
        rows.push_back({{"kind", row.kind}, {"of", row.of}, {"note", row.note}});
    }
    return html_page(form.name + ", form of readings",
                     filled(templates::readings_form, {{"name", form.name},
                                                       {"version", form.version},
                                                       {"readings", form.readings},
                                                       {"views", views},
                                                       {"rows", rows}}));
}

}  // namespace culet
