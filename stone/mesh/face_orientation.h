#pragma once
// Makes the faces of a surface run the same way round, judged by their neighbours alone.

#include <optional>
#include <vector>

namespace culet {

/// A side of a face between corners `low` and `high`; the face runs from low to high if `forward`.
struct FaceSide {
    int low = -1, high = -1, face = -1;
    bool forward = true;
};

void add_sides(const std::vector<int>& corners, int face, std::vector<FaceSide>& sides);

struct FacesToTurn {
    std::vector<bool> turn;  ///< by face; in each part the minority
    int parts = 0;           ///< number of connected parts
};

/// Which faces to turn so that all faces 0 .. count - 1 of a connected part run the same way round.
/// Nothing where an edge has not exactly two faces, or the surface has only one side.
std::optional<FacesToTurn> faces_to_turn(std::size_t count, std::vector<FaceSide> sides);

}  // namespace culet
