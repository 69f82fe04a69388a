#include "stone/errors.h"

namespace culet {

InputError::InputError(const std::filesystem::path& file, const std::string& message)
    : std::runtime_error(file.string() + ": " + message) {}

InputError::InputError(const std::filesystem::path& file, long line, const std::string& message)
    : std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + message) {}

}  // namespace culet
