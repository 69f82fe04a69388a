#pragma once
// Cut designs made for tests, as text of an .asc.

#include <string>
#include <vector>

namespace culet::test {

/// A stone of n mains and breaks on each side of the girdle, of half width 1.
struct Made {
    int gear = 96, offset = 0, folds = 8;
    double cheat = 0;  // teeth: the crown's mains come in pairs, this far off each other
    double twist = 0;  // teeth: the whole crown against the pavilion
    bool culet = false, crown_first = false, preform = false, unnamed = false, own_names = false;
    const char *instruction = "", *word = "C";
    int headings = 1, footnotes = 0;
    // What a .gcs and a .gem cannot keep of it; a piece of each note.
    std::vector<const char*> lost_in_gcs = {}, lost_in_gem = {};
};

std::string text_of(const Made& made);

}  // namespace culet::test
