#pragma once
// Keeps files that come from anybody within one folder.

#include <filesystem>

namespace culet {

/// The path of `name` in `folder`, with all links resolved; it need not exist. Throws InputError
/// when it is not within the folder.
std::filesystem::path path_within(const std::filesystem::path& folder,
                                  const std::filesystem::path& name);

/// While it lives, TOML files read in this thread may name files within `folder` only
/// (`TomlTable::path` refuses others).
class PathFence {
public:
    explicit PathFence(std::filesystem::path folder);
    ~PathFence();
    PathFence(const PathFence&) = delete;
    PathFence& operator=(const PathFence&) = delete;

private:
    friend void require_within_fence(const std::filesystem::path& file);
    std::filesystem::path folder_;
    PathFence* outer_;
};

/// Throws InputError when a fence stands and `file` is beyond it.
void require_within_fence(const std::filesystem::path& file);

}  // namespace culet
