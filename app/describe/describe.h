#pragma once
// What `culet info` says of a file: one function a kind of file.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "stone/design/cutting_list.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/material/material.h"
#include "stone/solid/checks.h"

namespace culet {

/// The same for every kind of file: lines for people, an object for programs, and what is wrong.
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
    double width_mm = 0;  ///< of a mesh or a cut design: scaled to this; 0: as it is
};

/// By extension; TOML files by their tables. Throws InputError for a kind that it does not know.
Description describe_file(const DescribeOptions& options);

/// Meshes and cut designs.
Description describe_solid_file(const DescribeOptions& options);
Description describe_stone_file(const DescribeOptions& options);
Description describe_scene_file(const DescribeOptions& options);
Description describe_material_file(const DescribeOptions& options);
Description describe_image_file(const DescribeOptions& options);
Description describe_ray_table(const DescribeOptions& options);

/// Adds a solid's figures and facets, and its faults. `must_be_convex` as the stone says.
void describe_solid(const Solid& solid, bool must_be_convex, bool facet_table, Description& about);
void describe_material(const Material& material, Description& about);

}  // namespace culet
