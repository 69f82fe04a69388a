// A third-party program: culet's installed headers and libraries suffice to build it.
#include <cstdio>

#include "stone/material/material.h"

int main() {
    const culet::Material diamond = culet::catalogue_material("diamond");
    std::printf("%.4f\n", diamond.index[0].at(589.3));
    return 0;
}
