#include "stone/text/path_fence.h"

#include <algorithm>

#include "stone/text/errors.h"

namespace culet {

namespace {

thread_local PathFence* standing = nullptr;

}  // namespace

std::filesystem::path path_within(const std::filesystem::path& folder,
                                  const std::filesystem::path& name) {
    std::error_code error;
    const std::filesystem::path root = std::filesystem::canonical(folder, error);
    if (error) throw InputError(folder, "no such folder");
    const std::filesystem::path file = std::filesystem::weakly_canonical(root / name, error);
    const auto [end, ignored] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
    if (error || end != root.end()) {
        throw InputError(name, "lies outside of the folder " + root.string() +
                                   ": copy the file into it, and name the copy");
    }
    return file;
}

PathFence::PathFence(std::filesystem::path folder) : folder_(std::move(folder)), outer_(standing) {
    standing = this;
}

PathFence::~PathFence() {
    standing = outer_;
}

void require_within_fence(const std::filesystem::path& file) {
    if (standing != nullptr) path_within(standing->folder_, std::filesystem::absolute(file));
}

}  // namespace culet
