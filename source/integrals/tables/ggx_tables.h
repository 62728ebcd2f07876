// The shipped tables of GGX and of Charlie's sheen. Their text is the fitter's own output, see ggx_tables.cpp.
#pragma once

#include "integrals/tables/table.h"

namespace steradian {

const ClassicTable& ggx_classic_table();
const CompactTable& ggx_compact_table();
const ClassicTable& ggx_fresnel_table();  // for the lobe times (1 - v.h)^5
const CompactTable& charlie_compact_table();

}  // namespace steradian
