#pragma once
// What every reader's fuzzer does with the bytes: parse, check, write. Only InputError may be
// thrown.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "stone/design/proportions.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {

template <class Parse>
int fuzz_reader(const std::uint8_t* data, std::size_t size, Parse parse) {
    try {
        const Solid solid = parse(std::string_view(reinterpret_cast<const char*>(data), size));
        find_faults(solid);
        proportions(solid);
        for (const MeshFormat format :
             {MeshFormat::obj, MeshFormat::off, MeshFormat::ply, MeshFormat::stl}) {
            mesh_text(solid, format);
        }
    } catch (const InputError&) {
    }
    return 0;
}

}  // namespace culet
