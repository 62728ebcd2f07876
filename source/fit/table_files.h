// Tables as files: DDS, EXR, C header, GLSL header, JSON, chosen by the name's ending.
#pragma once

#include <string>
#include <vector>

#include "integrals/tables/table.h"

namespace steradian::fit {

// The bytes of each file to write. Classic tables as .dds (half floats) or .exr are two files: NAME_1 contains the matrix, NAME_2 the
// magnitudes. All others are one file. Throws Error for an ending that the layout does not support.
struct TableFile {
  std::string path;
  std::string bytes;
};
std::vector<TableFile> classic_files(const ClassicTable& table, const std::string& lobe, const std::string& path);
std::vector<TableFile> compact_files(const CompactTable& table, const std::string& lobe, const std::string& path);

// Writes each file beside its target and then renames it.
void write_files(const std::vector<TableFile>& files);

}  // namespace steradian::fit
