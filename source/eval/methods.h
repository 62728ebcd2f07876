// What `steradian eval` takes from the table of methods.
#pragma once

#include "integrals/methods.h"

namespace steradian::eval {

using MethodOptions = RadianceOptions;
using LobeAnswer = RadianceResult;
using MethodEntry = methods::Row;
using methods::nothing;

}  // namespace steradian::eval
