// The sections of docs/measured/accuracy.md. A new section needs a file here with a function, and a line in accuracy.cpp.
#pragma once

#include <iosfwd>

namespace steradian::accuracy {

// Each function measures its numbers and writes Markdown that begins with its own `## heading`.
void write_functions(std::ostream& out);      // every kernel: float against double
void write_targets(std::ostream& out);        // every kernel: packs and GPUs against scalar float
void write_lambert(std::ostream& out);        // polygons on Lambert surfaces: double against quadrature, float against double
void write_diffuse_below(std::ostream& out);  // a diffuse lobe under a dielectric's boundary
void write_sheen(std::ostream& out);          // Charlie by its cubature
void write_phong(std::ostream& out);          // Phong lobes by every method
void write_ggx(std::ostream& out);            // GGX by every real-time method against the reference
void write_point_lights(std::ostream& out);   // transformed cosines towards lights without extent
void write_half_vector(std::ostream& out);    // edge splitting against the reference
void write_lights(std::ostream& out);         // small, near and grazing lights, half vectors with shadowing, textured lights
void write_limits(std::ostream& out);         // lights that fill the hemisphere, touch the surface, are edge-on, or are round and near

}  // namespace steradian::accuracy
