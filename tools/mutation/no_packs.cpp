// Stubs of the renderer's packs for the kernels' tests. This program is built without packs, so such tests fail here and are skipped.
#include <stdexcept>
#include <vector>

#include "bench/studies/table2.h"
#include "render/direct/lobe_packs.h"

namespace steradian {
namespace {
[[noreturn]] void refuse() { throw std::logic_error("no packs here"); }
}  // namespace

PackLight prepare_light(const PreparedPolygon&) { refuse(); }
LtcPackTables ltc_pack_tables(Method, Quality, const ClassicTable*) { refuse(); }

namespace moment {
const std::vector<ComparedMethod>& compared_methods() { refuse(); }
}  // namespace moment

namespace isa_sse2 {
const LobePacks& lobe_packs() { refuse(); }
}  // namespace isa_sse2

}  // namespace steradian
