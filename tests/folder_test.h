#pragma once
// The fixture of tests that write files: a scratch folder for each.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/scratch_folder.h"

namespace culet::test {

class FolderTest : public testing::Test {
protected:
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return file(name);
    }
    /// The content of a file: a name within the folder, or a whole path.
    std::string text(const std::string& name) const {
        std::ifstream stream(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    ScratchFolder folder_;
};

}  // namespace culet::test
