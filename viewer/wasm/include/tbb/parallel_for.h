#pragma once
// TBB's loops that culet uses, run sequentially. WebAssembly in a page has one thread: threads need
// headers that a file opened by a double click does not have.

#include <tbb/partitioner.h>

namespace tbb {

template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
    for (Index i = first; i < last; ++i) body(i);
}

template <class Index, class Body, class Partitioner>
void parallel_for(Index first, Index last, const Body& body, const Partitioner&) {
    parallel_for(first, last, body);
}

}  // namespace tbb
