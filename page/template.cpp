#include "page/template.h"

#include <kainjow/mustache.hpp>
#include <sstream>
#include <stdexcept>

#include "page/html.h"

namespace culet {

namespace {

namespace mustache = kainjow::mustache;

// The library itself silently ignores missing names.
class StrictContext : public mustache::context<std::string> {
public:
    explicit StrictContext(const mustache::data* data) : context(data) {}

    const mustache::data* get(const std::string& name) const override {
        const mustache::data* found = context::get(name);
        if (found == nullptr) throw std::logic_error("nothing is called " + name);
        return found;
    }
    const mustache::data* get_partial(const std::string& name) const override { return get(name); }
};

mustache::data data_of(const View& view);

mustache::data data_of_value(bool truth) {
    return truth;
}

mustache::data data_of_value(const std::string& text) {
    return text.empty() ? mustache::data(false) : mustache::data(text);
}

mustache::data data_of_value(const std::vector<View>& list) {
    mustache::data data(mustache::data::type::list);
    for (const View& one : list) data.push_back(data_of(one));
    return data;
}

mustache::data data_of_value(const View::Parts& parts) {
    mustache::data data;
    for (const auto& [name, part] : parts) data.set(name, data_of(part));
    return data;
}

mustache::data data_of(const View& view) {
    return std::visit([](const auto& value) { return data_of_value(value); }, view.value());
}

}  // namespace

std::string filled(const Template& form, const View& view) {
    const auto refuse = [&](const std::string& why) {
        throw std::logic_error(std::string("template ") + form.name + ": " + why);
    };
    mustache::mustache parsed{std::string(form.text)};
    parsed.set_custom_escape([](const std::string& text) { return escaped(text); });
    if (!parsed.is_valid()) refuse(parsed.error_message());
    const mustache::data data = data_of(view);
    StrictContext context(&data);
    std::ostringstream text;
    try {
        parsed.render(context, text);
    } catch (const std::logic_error& error) {
        refuse(error.what());
    }
    if (!parsed.is_valid()) refuse(parsed.error_message());
    return std::move(text).str();
}

}  // namespace culet
