#include "stone/mesh_io.h"
namespace culet {}
