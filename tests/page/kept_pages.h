#pragma once
// Pages that a browser test opens (pages_in_browser_test.py): tests store theirs in the folder
// CULET_KEPT_PAGES, if it is set.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace culet::test {

/// Right to left, with tags and quotes, and longer than a line without any place to break it.
inline std::string hostile_name() {
    return "שם של אבן \"'><img src=x onerror=\"document.title='x'\"> " + std::string(140, 'W');
}

inline void keep_page(const std::string& name, const std::string& page) {
    const char* const folder = std::getenv("CULET_KEPT_PAGES");
    if (folder == nullptr) return;
    std::ofstream(std::filesystem::path(folder) / (name + ".html"), std::ios::binary) << page;
}

}  // namespace culet::test
