#include "stone/mesh_io.h"

#include "stone/errors.h"

namespace culet {

ReadSolid read_mesh(const std::filesystem::path& file) {
    throw InputError(file, "meshes cannot be read yet");
}
void write_mesh(const Solid&, const std::filesystem::path& file) {
    throw InputError(file, "meshes cannot be written yet");
}

}  // namespace culet
