// Conversion of demodulated light to radiance.
#pragma once

#include "core/simd.h"
#include "render/bounce/receivers/receivers.h"
#include "render/direct/ltc_tables.h"

namespace steradian::indirect {

struct ResolveTable {
  // Rows [first, last): radiance = diffuse albedo / pi + glossy times Fresnel's mean over the lobe.
  void (*run)(const PictureSurfaces& surfaces, const IncomingLight& light, const LtcPackTables& tables, int first, int last,
              VectorArray& radiance);
};

}  // namespace steradian::indirect

namespace steradian {
STERADIAN_DECLARE_PACK_TABLE(indirect::ResolveTable, resolve_table)
}
