#pragma once
// A study as table, charts and page, all made from the study's JSON.

#include <string>

namespace culet {

struct StudyView {
    std::string study_json{};  ///< as written to study.json
    std::string title{}, version{}, command{};
};

/// All throw InputError when the study is not a JSON object.
/// Error against time, as text for a terminal.
std::string study_table(const std::string& study_json);
/// The same as a chart on logarithmic axes; empty when nothing was measured.
std::string study_time_chart(const std::string& study_json);
/// Error and its theoretical limit against the number of readings; empty likewise.
std::string study_limit_chart(const std::string& study_json);
std::string study_page(const StudyView& view);

}  // namespace culet
