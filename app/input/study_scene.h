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

/// Returns the exit code.
int study_scene_file(const StudySceneOptions& options);

/// Throws InputError when the folder cannot be made.
std::filesystem::path study_folder(const std::filesystem::path& folder);

}  // namespace culet
