// Stubs of the renderer's packs for the kernels' tests. This program is built without packs, so such tests fail here and are skipped.
#include <stdexcept>
#include <vector>

#include "bench/studies/table2.h"
#include "render/direct/closed_form.h"
#include "render/direct/ltc_points.h"
#include "render/direct/phong.h"
#include "render/direct/sheen.h"

namespace steradian {
namespace {
[[noreturn]] void refuse() { throw std::logic_error("no packs here"); }
}  // namespace

PackLight prepare_light(const PreparedPolygon&) { refuse(); }
LtcPackTables ltc_classic_pack_tables() { refuse(); }
LtcPackTables ltc_fresnel_pack_tables() { refuse(); }
LtcPackTables ltc_compact_pack_tables() { refuse(); }

namespace moment {
const std::vector<ComparedMethod>& compared_methods() { refuse(); }
}  // namespace moment

namespace isa_sse2 {
const ClosedFormTable& closed_form_table() { refuse(); }
const LtcPackTable& ltc_pack_table() { refuse(); }
const PhongTable& phong_table() { refuse(); }
const SheenTable& sheen_table() { refuse(); }
}  // namespace isa_sse2

}  // namespace steradian
