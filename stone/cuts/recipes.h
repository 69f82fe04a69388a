#pragma once
// The parameters of each standard cut, and how it is made from their values.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "stone/cuts/cuts.h"

namespace culet {

using CutValues = std::map<std::string, double>;

struct CutRecipe {
    CutKind kind;
    std::function<Solid(const CutValues&)> make;
};

const std::vector<CutRecipe>& cut_recipes();

}  // namespace culet
