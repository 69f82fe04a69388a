#pragma once
// Reads drawings back.

#include <cctype>
#include <cstring>
#include <set>
#include <string>
#include <vector>

namespace culet::test {

/// The fault in ` name="value" name="value"`. Parsed by hand because the library's regular
/// expressions recurse for every letter.
inline std::string attribute_fault(const std::string& text) {
    std::set<std::string> seen;
    for (std::size_t at = 0; (at = text.find_first_not_of(" \n", at)) != std::string::npos;) {
        const std::size_t equals = text.find("=\"", at);
        if (equals == std::string::npos) return "odd text";
        const std::string name = text.substr(at, equals - at);
        if (name.empty() || name.find_first_of(" \n<\"") != std::string::npos) return "odd text";
        if (!seen.insert(name).second) return "an attribute twice";
        const std::size_t end = text.find('"', equals + 2);
        if (end == std::string::npos) return "a value that never ends";
        if (text.find('<', equals) < end) return "a < in a value";
        at = end + 1;
    }
    return "";
}

/// The fault in nesting, attributes or entities of an XML text; empty if there is none.
inline std::string xml_fault(const std::string& text) {
    for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
        bool known = false;
        for (const char* entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"}) {
            known = known || text.compare(at, std::strlen(entity), entity) == 0;
        }
        if (!known) return "a bare &";
    }
    std::vector<std::string> open;
    int roots = 0;
    for (std::size_t at = 0; at < text.size();) {
        if (text[at] != '<') {
            if (text[at] == '>') return "a bare >";
            if (open.empty() && !std::isspace(static_cast<unsigned char>(text[at]))) {
                return "text outside the root";
            }
            ++at;
            continue;
        }
        std::size_t end = at + 1;
        for (bool quoted = false; end < text.size() && (quoted || text[end] != '>'); ++end) {
            if (text[end] == '"') quoted = !quoted;
        }
        if (end >= text.size()) return "a tag that never ends";
        std::string tag = text.substr(at + 1, end - at - 1);
        at = end + 1;
        if (tag.starts_with("/")) {
            if (open.empty() || open.back() != tag.substr(1)) return "<" + tag + "> closes nothing";
            open.pop_back();
            continue;
        }
        const bool closed = tag.ends_with("/");
        if (closed) tag.pop_back();
        const std::size_t name = tag.find_first_of(" \n");
        const std::string rest = name == std::string::npos ? "" : tag.substr(name);
        if (const std::string fault = attribute_fault(rest); !fault.empty()) {
            return fault + " in <" + tag + ">";
        }
        if (open.empty()) ++roots;
        if (!closed) open.push_back(tag.substr(0, name));
    }
    if (!open.empty()) return "<" + open.back() + "> is never closed";
    return roots == 1 ? "" : "not one root";
}

inline int count_of(const std::string& text, const std::string& what) {
    int count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++count;
    }
    return count;
}

}  // namespace culet::test
