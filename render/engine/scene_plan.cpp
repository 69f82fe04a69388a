#include "render/engine/scene_plan.h"

namespace culet {

const PlanItem& ScenePlan::item(const std::string& name) const {
    for (const PlanItem& line : items) {
        if (line.name == name) return line;
    }
    static const PlanItem none;
    return none;
}

}  // namespace culet
