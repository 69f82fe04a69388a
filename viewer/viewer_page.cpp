#include "viewer/viewer_page.h"

#include <utility>

#include "page/html.h"
#include "stone/text/errors.h"
#include "viewer/engine_file.h"
#include "viewer/templates.h"

namespace culet {

namespace embedded {
extern const char* const viewer_css;
extern const char* const viewer_js;
extern const char* const worker_js;
}  // namespace embedded

std::string viewer_page(ViewDocument document) {
    check(document.first >= 0 && document.first < static_cast<int>(document.items.size()),
          "a page of the viewer shows something first");
    // The page shows it at once; a second copy would be a tenth of the page.
    const std::string picture =
        std::exchange(document.items[static_cast<std::size_t>(document.first)].picture, {});
    return filled(templates::viewer, {{"title", document.title},
                                      {"picture", picture},
                                      {"viewer_css", embedded::viewer_css},
                                      {"viewer_js", embedded::viewer_js},
                                      {"worker_js", embedded::worker_js},
                                      {"engine", engine_for_pages()},
                                      {"document_json", json_for_script(document_json(document))}});
}

}  // namespace culet
