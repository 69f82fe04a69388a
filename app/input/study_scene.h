#pragma once
// The part of `culet study` that studies scenes.

#include <filesystem>
#include <string>

#include "app/program/options.h"

namespace culet {

struct StudySceneOptions {
    CommonOptions common;
    std::string input, out, json;
    int size = 0, runs = 5;
    double budget = 120;
};

/// Studies the scene, writes the results, and returns the exit code.
int study_scene_file(const StudySceneOptions& options);

/// Makes the folder for a study's results. Throws InputError when it cannot.
std::filesystem::path study_folder(const std::filesystem::path& folder);

}  // namespace culet
