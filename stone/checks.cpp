#include "stone/checks.h"
namespace culet {}
