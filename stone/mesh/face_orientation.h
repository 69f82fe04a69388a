#pragma once
// Which way round the faces of a surface run, told by their neighbours alone.

#include <optional>
#include <vector>

namespace culet {

/// A side of a face, from corner `low` to `high` where it runs `forward`.
struct FaceSide {
    int low = -1, high = -1, face = -1;
    bool forward = true;
};

void add_sides(const std::vector<int>& corners, int face, std::vector<FaceSide>& sides);

struct FacesToTurn {
    std::vector<bool> turn;  ///< by face; of each part the fewer
    int parts = 0;           ///< that do not hang together
};

/// So that all faces 0 .. count - 1 that hang together run alike. Nothing where an edge has not two
/// faces, or the surface has one side only.
std::optional<FacesToTurn> faces_to_turn(std::size_t count, std::vector<FaceSide> sides);

}  // namespace culet
