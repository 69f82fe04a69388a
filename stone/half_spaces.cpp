#include "stone/solid.h"
namespace culet {}
