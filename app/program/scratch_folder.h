#pragma once
// A temporary folder, removed with this object.

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "stone/text/errors.h"

namespace culet {

class ScratchFolder {
public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "culet-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw InputError(name, "cannot be made, for temporary pictures");
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace culet
