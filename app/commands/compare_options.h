#pragma once
// The options of `culet compare`.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/program/options.h"
#include "compare/calibration/scene_comparison.h"

namespace culet {

struct CompareArguments {
    CommonOptions common;
    std::string given;                  ///< the command line
    std::vector<std::string> pictures;  ///< photographs, then the render or the scene
    std::string folder, json, mask, cache, start, uncertainty;
    std::vector<std::string> ignored;
    bool simulated = false, calibrate = false, keep_pose = false;
    double budget = SceneCompareOptions{}.budget_seconds;
    int draws = 8;

    std::size_t photographs() const { return pictures.size() - 1; }
    const std::string& against() const { return pictures.back(); }
    bool against_scene() const { return std::filesystem::path(against()).extension() == ".toml"; }
};

/// For people; `name_of` gives the word used in files.
std::string verdict_words(Verdict verdict);

/// `arguments` must outlive `command`.
void add_compare_options(CLI::App& command, CompareArguments& arguments);

}  // namespace culet
