// oneTBB's parallel_for for a machine of one thread: a page's WebAssembly has no other without cross-origin isolation.
#pragma once

namespace tbb {

template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
  for (Index i = first; i < last; ++i) body(i);
}

}  // namespace tbb
