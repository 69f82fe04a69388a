#include "studio/studio_page.h"

#include "studio/templates.h"

namespace culet {

namespace embedded {
extern const char* const page_css;
extern const char* const studio_css;
extern const char* const studio_js;
}  // namespace embedded

std::string studio_page(const std::string& version) {
    return filled(templates::studio, {{"version", version}});
}

const std::string& studio_css() {
    static const std::string css = std::string(embedded::page_css) + embedded::studio_css;
    return css;
}

const std::string& studio_js() {
    static const std::string js = embedded::studio_js;
    return js;
}

}  // namespace culet
