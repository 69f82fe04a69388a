#pragma once
// The one page of the studio, and its files.

#include <string>

namespace culet {

std::string studio_page(const std::string& version);
/// The look of all pages (page/page.css), and the studio's own.
const std::string& studio_css();
const std::string& studio_js();

}  // namespace culet
