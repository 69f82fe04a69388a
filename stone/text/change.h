#pragma once
// What reading changed of an input, for reports.

#include <string>

namespace culet {

struct Change {
    std::string what, why;
    double before = 0, after = 0;
    std::string measure;  ///< what `before` and `after` measure
};

inline Change facets_turned_round(const std::string& why, int count) {
    return {"facets turned round", why, double(count), 0, "facets inside out"};
}

/// Works for any JSON type of nlohmann's.
template <class Json>
void to_json(Json& json, const Change& change) {
    json = Json{{"what", change.what},
                {"why", change.why},
                {"before", change.before},
                {"after", change.after},
                {"measure", change.measure}};
}

}  // namespace culet
