#pragma once
// What `culet info` says about a file: one function per kind of file.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stone/design/cut_measures.h"
#include "stone/design/cutting_list.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/material/material.h"
#include "stone/solid/checks.h"

namespace culet {

/// Lines for people, a JSON object for programs, and the faults.
struct Description {
    std::vector<std::string> lines, notes;
    nlohmann::ordered_json object;  ///< keys in snake_case, `format` first
    std::vector<Fault> faults;
};

struct DescribeOptions {
    std::filesystem::path file;
    std::vector<std::string> overrides;  ///< `key.path=value`, of TOML files
    CutReading cut;
    bool may_be_concave = false;
    bool facet_table = false;
    bool cutting_list = false;
    CuttingOptions cutting;
    double width_mm = 0;               ///< scale a mesh or a cut design to this width; 0: do not
    std::optional<ReportStyle> style;  ///< lists the proportions, rounded so
    std::filesystem::path report;      ///< of the stone's fit, for their sigmas; empty: none
};

/// Goes by the extension, for TOML files by their tables. Throws InputError for unknown kinds.
Description describe_file(const DescribeOptions& options);

/// Meshes and cut designs.
Description describe_solid_file(const DescribeOptions& options);
Description describe_stone_file(const DescribeOptions& options);
Description describe_scene_file(const DescribeOptions& options);
Description describe_material_file(const DescribeOptions& options);
Description describe_image_file(const DescribeOptions& options);
Description describe_ray_table(const DescribeOptions& options);

/// Two meshes or cut designs: what differs, in `differences`.
Description describe_difference(const DescribeOptions& options, const std::filesystem::path& other);

/// Adds a solid's figures, facets and faults. `must_be_convex` is the stone's.
void describe_solid(const Solid& solid, bool must_be_convex, bool facet_table, Description& about);
/// Adds the trade's proportions (stone/design/cut_measures.h) as `proportions`; with a style, as
/// lines too. With a report they are the fit's, with sigmas.
void describe_measures(const Solid& solid, const DescribeOptions& options, Description& about);
void describe_material(const Material& material, Description& about);

}  // namespace culet
