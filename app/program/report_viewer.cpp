#include "app/program/report_viewer.h"

#include "stone/text/errors.h"
#include "viewer/viewer_page.h"

namespace culet {

std::string viewer_for_report(const ViewSource& source, const std::string& title) {
    ViewDocument document;
    std::vector<std::string> notes;  // printed when the scene was drawn
    try {
        document.items.push_back(view_item(source, notes));
    } catch (const InputError&) {
        return {};  // the report does not depend on the viewer
    }
    if (!document.items.front().refused.empty()) return {};
    document.title = title;
    document.version = CULET_VERSION;
    return viewer_page(std::move(document));
}

}  // namespace culet
