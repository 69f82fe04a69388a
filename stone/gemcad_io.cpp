#include "stone/gemcad_io.h"

#include "stone/errors.h"

namespace culet {

ReadCut read_gemcad_asc(const std::filesystem::path& file, const CutReading&) {
    throw InputError(file, "cut designs cannot be read yet");
}
ReadCut read_gemcad_gem(const std::filesystem::path& file, const CutReading&) {
    throw InputError(file, "cut designs cannot be read yet");
}
void write_gemcad_asc(const Solid&, const CutSheet&, const std::filesystem::path& file) {
    throw InputError(file, "cut designs cannot be written yet");
}

}  // namespace culet
