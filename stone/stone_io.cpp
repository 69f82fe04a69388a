#include "stone/stone_io.h"
namespace culet {}
