#pragma once
// The one home of the template library (mustache, by kainjow): HTML stands in template files,
// escaped by default.

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace culet {

/// One of the files templates/*.html.mustache, built into the program; page/templates.h names them.
struct Template {
    const char* name;
    const char* text;
};

/// What a template is filled with: a text, a truth, a list, or parts with names. Empty texts and
/// lists are false to a section.
class View {
public:
    using Parts = std::vector<std::pair<std::string, View>>;

    View(std::string text) : value_(std::move(text)) {}
    View(const char* text) : value_(std::string(text)) {}
    template <std::same_as<bool> Truth>  // no number is taken for one
    View(Truth truth) : value_(truth) {}
    View(std::vector<View> list) : value_(std::move(list)) {}
    View(std::initializer_list<Parts::value_type> parts) : value_(Parts(parts)) {}

    const auto& value() const { return value_; }

private:
    std::variant<bool, std::string, std::vector<View>, Parts> value_;
};

/// `{{name}}` is escaped (page/html.h); `{{{name_html}}}`, and likewise _svg, _css, _js and _json,
/// is what this program made itself and stands as it is. A template that asks for what the view
/// does not have is our own fault: std::logic_error.
std::string filled(const Template& form, const View& view);

}  // namespace culet
