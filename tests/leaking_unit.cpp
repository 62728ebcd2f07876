// A pack unit with the mistake that tests/pack_symbols.py searches for: an inline function outside the unit's namespace.
namespace steradian {

__attribute__((noinline)) inline float leaks(float x) { return x * x + 1.0f; }
float (*const keep_leaks)(float) = leaks;
const void* leaking_unit() { return reinterpret_cast<const void*>(keep_leaks); }

}  // namespace steradian
