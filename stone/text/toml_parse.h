#pragma once
// Converts text to toml++'s tables and back. Private to the folder: shows toml++.

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stone/text/toml_file.h"

namespace culet {

struct TomlTable::Content {
    std::filesystem::path file;
    toml::table root;
    HeldFiles held;
};

/// Applies `overrides` (KEY.PATH=VALUE). Throws InputError.
toml::table parse_toml(std::string_view text, const std::filesystem::path& file,
                       const std::vector<std::string>& overrides);
void apply_override(toml::table& root, const std::string& setting);

/// Keys are dotted paths.
void erase_keys(toml::table& root, const std::vector<std::string>& keys);
/// Rewrites every text below `node` that names a file relative to `from` so that it is relative to
/// `to`.
void move_paths(toml::node& node, const std::filesystem::path& from,
                const std::filesystem::path& to);
std::string formatted_toml(const toml::table& root);

}  // namespace culet
