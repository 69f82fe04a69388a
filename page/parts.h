#pragma once
// The parts that pages are put together from. Each returns HTML.

#include <string>
#include <vector>

#include "page/colour_maps.h"
#include "page/template.h"

namespace culet {

/// A whole page in itself: loads nothing from anywhere, whatever a hostile name might contain.
/// `data_json` is kept inside it for programs; empty: none. `viewer_html` is a page of the viewer
/// (viewer/viewer_page.h), which `turn_button`s in the body open over this one; empty: none.
std::string html_page(const std::string& title, const std::string& body,
                      const std::string& data_json = {}, const std::string& viewer_html = {});

/// Opens the viewer; without a script, or in a page without a viewer, it is not there.
std::string turn_button();

/// `<section id=... >` with its heading; nothing when the body is empty.
std::string section(const std::string& id, const std::string& heading, const std::string& body);

/// Behind a line to click; nothing when the body is empty. The summary is HTML.
std::string folded(const std::string& summary, const std::string& body, bool open = false);

/// A section whose heading is that line.
std::string folded_section(const std::string& id, const std::string& heading,
                           const std::string& body, bool open = false);

/// One of the figures under a verdict: what it is, the figure, what to know about it.
std::string tile(const std::string& name, const std::string& value, const std::string& about,
                 const char* style = "");

/// The verdict at the top of a page: a word, a sign and a sentence or two.
std::string verdict_card(const char* style, const char* symbol, const std::string& word,
                         const std::string& sentences);

/// Items as a list; of a long one the first ones, the others folded.
struct ListItem {
    std::string lead;  ///< in bold with a stop behind; empty: none
    std::string text;
};
std::string short_list(const std::vector<ListItem>& items);

/// More rows than fill a screen: a table of them scrolls under its heading.
bool is_tall(const std::vector<View>& rows);

/// `rows` and `tall`, for a table that is left out when it has no rows.
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
