// The sections of docs/accuracy.md. A new one: a file here with a function, and a line in accuracy.cpp.
#pragma once

#include <iosfwd>

namespace steradian::accuracy {

// Each writes Markdown that begins with its own `## heading`, from numbers that it measures there and then.
void write_functions(std::ostream& out);  // every kernel: float against double
void write_targets(std::ostream& out);    // every kernel: packs and GPUs against scalar float

}  // namespace steradian::accuracy
