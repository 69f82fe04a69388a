#pragma once
// A photograph of a project's stone: the stone laid on it, and what a comparison says.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "studio/export_work.h"

namespace culet {

/// What work on a photograph starts from. A view is JSON: `turn` (of the stone, nine numbers row by
/// row: right, down and away), `at` and `sight` (pixels of the whole photograph), `scale` (pixels
/// per length) and `nearness`, as StoneView; it is never a mirrored one.
struct PhotographAsk {
    std::shared_ptr<const LoadedStone> loaded;
    FittedStone fitted;
    std::filesystem::path folder;  ///< the project's
    std::filesystem::path file;    ///< of the photograph
    std::string light;             ///< a preset; empty: the scene that the folder's job.toml names
    std::string view;              ///< empty: none yet
    bool placed = false;           ///< `view` is a person's: the stone is sought near it
    bool by_hand = false;          ///< its outline says where the stone is, not the background
    std::string version;           ///< of the program
};

/// Of the folder's job.toml; empty where it names none.
struct PhotographJob {
    std::filesystem::path photo, mask, scene;
    bool simulated = false;
};
/// Throws InputError; without a job.toml all are empty.
PhotographJob photograph_job(const std::filesystem::path& folder);

/// JSON: `files`, names of the folder's pictures, and `lights`, names of presets; an empty one
/// stands for the scene of job.toml.
std::string photographs_json(const std::filesystem::path& folder);

/// JSON, one line: `width`, `height`, `notes`, `light` and `view` to begin with, and `wire`, the
/// stone's corners and facets; then a PNG of the photograph. Throws InputError.
std::string opened_photograph(PhotographAsk ask);

/// Finds the stone: `found`, `sure`, `view`, `wire` and `card_html`, a verdict. Throws InputError
/// and Interrupted.
std::string laid_photograph(const PhotographAsk& ask, const Progress& progress);

enum class PhotographLook {
    quick,   ///< as the stone lies
    nearby,  ///< views nearby too, since the edges leave it unsure: as culet compare
    open     ///< and what the readings leave open
};
/// Compares with a render: `html`, parts of a report, `notes`, and `view`, if a better one was
/// found. Throws InputError and Interrupted.
std::string compared_photograph(const PhotographAsk& ask, PhotographLook look,
                                const Progress& progress);

}  // namespace culet
