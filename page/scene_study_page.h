#pragma once
// The study of a scene as table, chart and page, all made from its JSON.

#include <string>
#include <vector>

namespace culet {

/// A render on the Pareto front, by its id in the JSON; -1: the reference. PNG data URIs.
struct SceneStudyPicture {
    int id = -1;
    std::string picture, difference;
    double difference_scale = 0;  ///< in units of the mean radiance: where the colours saturate
};

struct SceneStudyView {
    std::string study_json{};  ///< as written to study.json
    std::string title{}, version{}, command{};
    std::vector<SceneStudyPicture> pictures{};
};

/// All throw InputError when the study is not a JSON object.
/// The front and the recommendations, as text for a terminal.
std::string scene_study_table(const std::string& study_json);
/// Every setting's error against processor time, logarithmic, with the front; empty when nothing
/// was drawn.
std::string scene_study_chart(const std::string& study_json);
std::string scene_study_page(const SceneStudyView& view);

}  // namespace culet
