#include "fit/fit.h"
