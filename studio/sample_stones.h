#pragma once
// Stones to try the studio with, which are part of the program (samples).

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

struct SampleStone {
    std::string name, words;
};

const std::vector<SampleStone>& sample_stones();

/// Writes it to a new folder within `folder`, or finds it there as it is. Returns its stone file.
/// Throws InputError.
std::filesystem::path project_of_sample(const std::filesystem::path& folder,
                                        const std::string& name);

}  // namespace culet
