#include "core/budget.h"

#include <charconv>
#include <iterator>

namespace steradian {
namespace {

// Formats a number with three digits and a unit that grows by 1000.
std::string readable(std::uint64_t number, const char* const (&units)[5]) {
  double x = static_cast<double>(number);
  std::size_t unit = 0;
  for (; x >= 999.5 && unit + 1 < std::size(units); ++unit) x /= 1000;
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, 3).ptr) + units[unit];
}

std::string readable_steps(std::uint64_t steps) {
  return readable(steps, {" steps", " thousand steps", " million steps", " billion steps", " trillion steps"});
}

}  // namespace

std::string readable_bytes(std::uint64_t bytes) { return readable(bytes, {" bytes", " kB", " MB", " GB", " TB"}); }

void Budget::take_memory(const std::string& place, std::string_view what, std::uint64_t bytes) {
  const std::uint64_t left = limits_.memory - memory_;
  if (bytes > left)
    throw Error(place,
                "would take " + readable_bytes(bytes) + " of memory for " + std::string(what) + ", " + readable_bytes(left) + " of " +
                    readable_bytes(limits_.memory) + " are left",
                "raise the limit with --max-memory, or use less");
  memory_ += bytes;
  last_place_ = place;
  last_what_ = what;
  last_bytes_ = bytes;
}

void Budget::take_work(const std::string& place, std::string_view what, std::uint64_t steps) {
  const std::uint64_t left = limits_.work - work_;
  if (steps > left)
    throw Error(place,
                "would take " + readable_steps(steps) + " for " + std::string(what) + ", " + readable_steps(left) + " of " +
                    readable_steps(limits_.work) + " are left",
                "raise the limit with --max-work, or use less");
  work_ += steps;
}

Error Budget::out_of_memory() const {
  if (last_what_.empty()) return Error("", "the machine ran out of memory", "free some memory, or use less");
  return Error(last_place_,
               "the machine ran out of memory after " + readable_bytes(memory_) + ", the last of them " + readable_bytes(last_bytes_) +
                   " for " + last_what_,
               "free some memory, or use less");
}

}  // namespace steradian
