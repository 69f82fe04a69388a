#pragma once
// The building blocks of pages. Each returns HTML.

#include <string>
#include <vector>

#include "page/colour_maps.h"
#include "page/template.h"

namespace culet {

/// A self-contained page, which loads nothing even if a name tries to make it. `data_json` is kept
/// inside for programs; empty: none. `viewer_html` is a page of the viewer (viewer/viewer_page.h)
/// that opens over this one by `turn_button`; empty: none.
std::string html_page(const std::string& title, const std::string& body,
                      const std::string& data_json = {}, const std::string& viewer_html = {});

/// Opens the viewer. Hidden without scripts, or in a page without a viewer.
std::string turn_button();

/// `<section id=... >` with its heading; empty when the body is empty.
std::string section(const std::string& id, const std::string& heading, const std::string& body);

/// Collapsible HTML; the summary is HTML too. Empty when the body is empty.
std::string folded(const std::string& summary, const std::string& body, bool open = false);

/// The heading is the summary.
std::string folded_section(const std::string& id, const std::string& heading,
                           const std::string& body, bool open = false);

/// A figure under a verdict: name, figure, explanation.
std::string tile(const std::string& name, const std::string& value, const std::string& about,
                 const char* style = "");

/// The verdict at the top of a page: a word, a symbol and a sentence or two.
std::string verdict_card(const char* style, const char* symbol, const std::string& word,
                         const std::string& sentences);

/// Long lists show their first items and collapse the others.
struct ListItem {
    std::string lead;  ///< in bold, followed by a full stop; empty: none
    std::string text;
};
std::string short_list(const std::vector<ListItem>& items);

/// True for more rows than fit on a screen: the table then scrolls under its heading.
bool is_tall(const std::vector<View>& rows);

/// `rows` and `tall`, for a table that is omitted when it has no rows.
View table_view(const std::vector<View>& rows);

/// A bar with ticks: from, middle, to.
std::string colour_bar(ColourMap map, const std::string& what, const std::string& from,
                       const std::string& middle, const std::string& to);

/// Two pictures (PNG data URIs of one size) under a slider.
struct SliderSide {
    std::string label, uri, alternative;
};
std::string slider(const std::string& id, const SliderSide& left, const SliderSide& right);

}  // namespace culet
