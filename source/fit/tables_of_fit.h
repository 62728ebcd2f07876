// The two layouts of a table, built from a fit.
#pragma once

#include "fit/fit.h"
#include "integrals/tables/table.h"

namespace steradian::fit {

ClassicTable classic_table(const LtcTable& fit, ClassicNormalisation normalisation = ClassicNormalisation::middle);

struct CompactSizes {
  int shape = 16;
  int magnitude = 22;  // together 3984 bytes
};

// The coarse values are those whose interpolation is nearest to the fine ones in least squares.
CompactTable compact_table(const LtcTable& fit, CompactSizes sizes = {});

// The fit itself at its nodes, and interpolated in the shapes between them.
LtcValue look_up_shapes(const LtcTable& fit, double roughness, double cos_theta);

}  // namespace steradian::fit
