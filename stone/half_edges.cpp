#include "stone/half_edges.h"
namespace culet {}
