#pragma once
// The only user of the template library (mustache, by kainjow). HTML stands in template files and
// is escaped by default.

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace culet {

/// One of the files templates/*.html.mustache, built into the program; page/templates.h lists them.
struct Template {
    const char* name;
    const char* text;
};

/// A template's values: a text, a boolean, a list, or named parts. Empty texts and lists count as
/// false for sections.
class View {
public:
    using Parts = std::vector<std::pair<std::string, View>>;

    View(std::string text) : value_(std::move(text)) {}
    View(const char* text) : value_(std::string(text)) {}
    template <std::same_as<bool> Truth>  // so that numbers do not convert
    View(Truth truth) : value_(truth) {}
    View(std::vector<View> list) : value_(std::move(list)) {}
    View(std::initializer_list<Parts::value_type> parts) : value_(Parts(parts)) {}

    const auto& value() const { return value_; }

private:
    std::variant<bool, std::string, std::vector<View>, Parts> value_;
};

/// `{{name}}` is escaped (page/html.h). `{{{name_html}}}`, also with _svg, _css, _js and _json, is
/// inserted unchanged: only this program's own output may go there. Throws std::logic_error if the
/// view lacks a name of the template, which is a bug.
std::string filled(const Template& form, const View& view);

}  // namespace culet
