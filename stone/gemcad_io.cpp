#include "stone/gemcad_io.h"
namespace culet {}
