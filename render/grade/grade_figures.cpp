#include "render/grade/grade_figures.h"

#include "stone/numbers/units.h"

namespace culet {

std::vector<GradeFigure> figures_of(const Grade& grade) {
    std::vector<GradeFigure> figures;
    const char* words[] = {"light return, even light", "light return, cosine light",
                           "light return, light from the sides", "light return, uneven light",
                           "light return, cos^2, no head"};
    for (const bool table : {false, true}) {
        if (table && grade.table < 0) continue;
        const LightReturn& values = table ? grade.face_up.table : grade.face_up.whole;
        for (int m = 0; m < k_light_model_count; ++m) {
            const auto i = static_cast<std::size_t>(m);
            figures.push_back(
                {name_of(static_cast<LightModel>(m)) + std::string(table ? "_table" : ""),
                 words[i] + std::string(table ? ", through the table" : ""), 100 * values[i],
                 true});
        }
    }
    const auto add = [&](const char* name, const char* what, double value) {
        figures.push_back({name, what, value, false});
    };
    add("aset.red", "ASET red", grade.aset.red);
    add("aset.green", "ASET green", grade.aset.green);
    add("aset.blue", "ASET blue", grade.aset.blue);
    add("aset.dark", "ASET dark", grade.aset.dark);
    add("ideal_scope.red", "ideal-scope red", grade.ideal_scope.red);
    add("ideal_scope.dark", "ideal-scope dark", grade.ideal_scope.dark);
    add("ideal_scope.white", "ideal-scope white", grade.ideal_scope.white);
    add("dark_field", "dark field", grade.dark_field);
    add("balance.return", "useful return", grade.balance.useful);
    add("balance.head", "returned into the viewer's head", grade.balance.head);
    add("balance.other", "out of the crown elsewhere", grade.balance.other);
    add("balance.leak", "leaks", grade.balance.leak);
    add("balance.entry_reflection", "reflected on entry", grade.balance.entry_reflection);
    add("balance.residual", "not followed to the end", grade.balance.residual);
    add("weighted_light_return", "weighted light return (GIA)", grade.weighted_return);
    add("head_shadow", "taken away by the head", grade.head_shadow);
    if (grade.fire) {
        add("fire.separated", "fire", grade.fire->separated);
        add("fire.spectral", "spectral fire", grade.fire->spectral);
        add("fire.spread_deg", "mean spread of colours, degrees", degrees(grade.fire->spread));
    }
    add("hearts.evenness", "evenness of the hearts", grade.hearts.evenness);
    add("hearts.cleft", "clefts of the hearts", grade.hearts.cleft);
    add("arrows.evenness", "evenness of the arrows", grade.arrows.evenness);
    return figures;
}

}  // namespace culet
