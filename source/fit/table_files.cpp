#include "fit/table_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "fit/lobe.h"
#include "integrals/tables/table.h"
#include "steradian/error.h"

namespace steradian::fit {
namespace {

using Texels = std::vector<std::array<float, 4>>;

std::string ending_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(dot);
}

std::string numbered(const std::string& path, const char* number) {
  const std::size_t dot = path.rfind('.');
  return path.substr(0, dot) + number + path.substr(dot);
}

// Turns disney-diffuse into disney_diffuse, a name in C and GLSL.
std::string identifier(std::string lobe) {
  std::replace(lobe.begin(), lobe.end(), '-', '_');
  return lobe;
}

void append_little_endian(std::string& bytes, std::uint32_t x) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((x >> (8 * i)) & 0xff));
}

// DDS with the DX10 header: format 10, R16G16B16A16_FLOAT. Source: Microsoft, "Programming guide for DDS".
std::string dds(const Texels& texels, int size) {
  const auto side = static_cast<std::uint32_t>(size);
  std::string bytes = "DDS ";
  const std::uint32_t flags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000;  // caps, height, width, pitch, pixel format
  for (std::uint32_t x : {124u, flags, side, side, side * 8, 0u, 1u}) append_little_endian(bytes, x);
  for (int i = 0; i < 11; ++i) append_little_endian(bytes, 0);
  for (std::uint32_t x : {32u, 0x4u, 0x30315844u, 0u, 0u, 0u, 0u, 0u}) append_little_endian(bytes, x);  // "DX10"
  for (std::uint32_t x : {0x1000u, 0u, 0u, 0u, 0u}) append_little_endian(bytes, x);                     // a texture
  for (std::uint32_t x : {10u, 3u, 0u, 1u, 0u}) append_little_endian(bytes, x);                         // half float, two-dimensional, one
  for (const auto& texel : texels)
    for (float x : texel) {
      const std::uint16_t half = half_from_float(x);
      bytes.push_back(static_cast<char>(half & 0xff));
      bytes.push_back(static_cast<char>(half >> 8));
    }
  return bytes;
}

std::string exr(const Texels& texels, int size) {
  Imf::Header header(size, size);
  Imf::FrameBuffer frame;
  const char* const names[4] = {"R", "G", "B", "A"};
  for (std::size_t c = 0; c < 4; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    const float* base = texels.data()->data() + c;  // OpenEXR wants a non-const pointer even for reading
    frame.insert(names[c], Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(base)), sizeof(texels[0]),
                                      sizeof(texels[0]) * static_cast<std::size_t>(size)));
  }
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(size);
  }
  return stream.str();
}

// The shortest decimal that parses to the same float.
std::string decimal(float x) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  return {text.data(), end};
}

std::string float_literal(float x) {
  std::string s = decimal(x);
  if (s.find_first_of(".en") == std::string::npos) s += ".0";
  return s;
}

std::string hexadecimal(std::uint32_t x, int digits) {
  std::string s = "0x";
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) s += "0123456789abcdef"[(x >> shift) & 15];
  return s;
}

// Joins the items with commas, in lines of at most 118 characters.
std::string lines(const std::vector<std::string>& items, const std::string& indent) {
  std::string text, line = indent;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? "," : "");
    if (line.size() + item.size() + 1 > 118) {
      text += line + "\n";
      line = indent;
    }
    line += (line == indent ? "" : " ") + item;
  }
  return text + line + "\n";
}

template <std::size_t N, class Format>
std::vector<std::string> formatted(const std::vector<std::array<float, N>>& values, Format format) {
  std::vector<std::string> items;
  for (const auto& value : values)
    for (float x : value) items.push_back(format(x));
  return items;
}

template <std::size_t N>
std::vector<std::string> half_words(const std::vector<std::array<float, N>>& values) {
  std::vector<std::string> items;
  for (const auto& value : values)
    for (std::size_t c = 0; c < N; c += 2)
      items.push_back(hexadecimal(half_from_float(value[c]) | (static_cast<std::uint32_t>(half_from_float(value[c + 1])) << 16), 8) + "u");
  return items;
}

std::string preamble(const std::string& lobe, const std::string& what, const std::string& command) {
  const std::string head = "// Linearly transformed cosines of the lobe " + lobe + ": " + what + "\n";
  const auto& known = lobe_families();
  if (std::none_of(known.begin(), known.end(), [&](const LobeFamily& family) { return family.name == lobe; })) return head;
  return head + "// Made by: steradian fit --lobe " + lobe + " " + command +
         "\n// SPDX-License-Identifier: MIT, (c) 2026 The Steradian authors.\n";
}

const char* const kClassicText =
    "the classic layout.\n"
    "// Roughness along a row, sqrt(1 - cos theta) from row to row, nodes on the ends. matrix: M^-1 over its middle\n"
    "// element, column 0 row 0, column 0 row 2, column 2 row 0, column 2 row 2. magnitude: n_A, f_A, 0, form factor of\n"
    "// a sphere clipped by the horizon.";
const char* const kClassicLastText =
    "the classic layout, of another normalisation.\n"
    "// Roughness along a row, sqrt(1 - cos theta) from row to row, nodes on the ends. matrix: M^-1 over its last\n"
    "// element, column 0 row 0, column 0 row 2, column 2 row 0, column 1 row 1. magnitude: n_A, f_A, 0, form factor of\n"
    "// a sphere clipped by the horizon.";
const char* const kCompactText =
    "the compact layout.\n"
    "// Roughness along a row, sqrt(1 - cos theta) from row to row, nodes on the ends; half floats, two in a word, the\n"
    "// first in the low bits. shape: the four entries that ltc_from_compact takes. magnitude: n_A, f_A.";

std::string c_array(const std::string& type, const std::string& name, const std::vector<std::string>& items) {
  return "static const " + type + " " + name + "[" + std::to_string(items.size()) + "] = {\n" + lines(items, "    ") + "};\n";
}

std::string c_size(const std::string& name, int size) { return "enum { " + name + "_size = " + std::to_string(size) + " };\n"; }

std::string glsl_array(const std::string& type, const std::string& name, const std::vector<std::string>& items) {
  const std::string full = type + "[" + std::to_string(items.size()) + "]";
  return "const " + type + " " + name + "[" + std::to_string(items.size()) + "] = " + full + "(\n" + lines(items, "    ") + ");\n";
}

std::string glsl_size(const std::string& name, int size) { return "const int " + name + "_size = " + std::to_string(size) + ";\n"; }

std::vector<std::string> vec4s(const Texels& texels) {
  std::vector<std::string> items;
  for (const auto& t : texels)
    items.push_back("vec4(" + float_literal(t[0]) + ", " + float_literal(t[1]) + ", " + float_literal(t[2]) + ", " + float_literal(t[3]) +
                    ")");
  return items;
}

// Reads a compact table in a shader: four fetches, bilinear. %s stands for the lobe.
const char* const kGlslReader = R"(
// The shape at ltc_coordinates, for ltc_from_compact.
vec4 ltc_%s_shape_at(vec2 coordinates) {
    vec2 p = clamp(coordinates, 0.0, 1.0) * float(ltc_%s_shape_size - 1);
    ivec2 i = min(ivec2(p), ivec2(ltc_%s_shape_size - 2));
    vec2 f = p - vec2(i);
    vec4 corners[4];
    for (int k = 0; k < 4; ++k) {
        int at = 2 * ((i.y + k / 2) * ltc_%s_shape_size + i.x + k % 2);
        corners[k] = vec4(unpackHalf2x16(ltc_%s_shape[at]), unpackHalf2x16(ltc_%s_shape[at + 1]));
    }
    return mix(mix(corners[0], corners[1], f.x), mix(corners[2], corners[3], f.x), f.y);
}

// n_A and f_A at ltc_coordinates.
vec2 ltc_%s_magnitude_at(vec2 coordinates) {
    vec2 p = clamp(coordinates, 0.0, 1.0) * float(ltc_%s_magnitude_size - 1);
    ivec2 i = min(ivec2(p), ivec2(ltc_%s_magnitude_size - 2));
    vec2 f = p - vec2(i);
    vec2 corners[4];
    for (int k = 0; k < 4; ++k) {
        int at = (i.y + k / 2) * ltc_%s_magnitude_size + i.x + k % 2;
        corners[k] = unpackHalf2x16(ltc_%s_magnitude[at]);
    }
    return mix(mix(corners[0], corners[1], f.x), mix(corners[2], corners[3], f.x), f.y);
}
)";

std::string with_name(std::string text, const std::string& name) {
  for (std::size_t at = text.find("%s"); at != std::string::npos; at = text.find("%s", at)) text.replace(at, 2, name);
  return text;
}

[[noreturn]] void refuse(const std::string& path, const std::string& layout, const std::string& known) {
  throw Error(path, "no form of the " + layout + " layout has the ending '" + ending_of(path) + "'", "use " + known);
}

}  // namespace

std::vector<TableFile> classic_files(const ClassicTable& table, const std::string& lobe, const std::string& path) {
  const std::string ending = ending_of(path), name = "ltc_" + identifier(lobe);
  const bool last = table.normalisation == ClassicNormalisation::last;
  const std::string head = preamble(lobe, last ? kClassicLastText : kClassicText,
                                    "--size " + std::to_string(table.size) + " --layout classic" + (last ? " --normalisation last" : ""));
  if (ending == ".dds")
    return {{numbered(path, "_1"), dds(table.matrix, table.size)}, {numbered(path, "_2"), dds(table.magnitude, table.size)}};
  if (ending == ".exr")
    return {{numbered(path, "_1"), exr(table.matrix, table.size)}, {numbered(path, "_2"), exr(table.magnitude, table.size)}};
  if (ending == ".h") {
    const auto literal = [](float x) { return float_literal(x) + "f"; };
    return {{path, head + "#pragma once\n\n" + c_size(name, table.size) +
                       c_array("float", name + "_matrix", formatted(table.matrix, literal)) +
                       c_array("float", name + "_magnitude", formatted(table.magnitude, literal))}};
  }
  if (ending == ".glsl")
    return {{path, head + "\n" + glsl_size(name, table.size) + glsl_array("vec4", name + "_matrix", vec4s(table.matrix)) +
                       glsl_array("vec4", name + "_magnitude", vec4s(table.magnitude))}};
  if (ending == ".json") {
    nlohmann::ordered_json json = {{"lobe", lobe}, {"layout", "classic"}};
    if (last) json["normalisation"] = "last";
    json["size"] = table.size;
    json["matrix"] = table.matrix;
    json["magnitude"] = table.magnitude;
    return {{path, json.dump() + "\n"}};
  }
  refuse(path, "classic", ".dds, .exr, .h, .glsl or .json");
}

std::vector<TableFile> compact_files(const CompactTable& table, const std::string& lobe, const std::string& path) {
  const std::string ending = ending_of(path), name = "ltc_" + identifier(lobe);
  const std::string head = preamble(lobe, kCompactText, "--layout compact");
  const std::string mirror = table.frame == LobeFrame::mirror ? "mirror" : "normal";
  const std::string frame =
      "// Stored about the " + mirror + (table.frame == LobeFrame::mirror ? " direction.\n" : ": pass alpha = 1 and view = (0, 0, 1).\n");
  if (ending == ".h")
    return {{path, head + frame + "#pragma once\n\n" + c_size(name + "_shape", table.shape_size) +
                       c_array("unsigned int", name + "_shape", half_words(table.shapes)) +
                       c_size(name + "_compact_magnitude", table.magnitude_size) +
                       c_array("unsigned int", name + "_compact_magnitude", half_words(table.magnitudes))}};
  if (ending == ".glsl")
    return {{path, head + frame + "\n" + glsl_size(name + "_shape", table.shape_size) +
                       glsl_array("uint", name + "_shape", half_words(table.shapes)) +
                       glsl_size(name + "_magnitude", table.magnitude_size) +
                       glsl_array("uint", name + "_magnitude", half_words(table.magnitudes)) + with_name(kGlslReader, identifier(lobe))}};
  if (ending == ".json") {
    nlohmann::ordered_json json = {{"lobe", lobe},
                                   {"layout", "compact"},
                                   {"frame", mirror},
                                   {"shape_size", table.shape_size},
                                   {"shape", table.shapes},
                                   {"magnitude_size", table.magnitude_size},
                                   {"magnitude", table.magnitudes}};
    return {{path, json.dump() + "\n"}};
  }
  refuse(path, "compact", ".h, .glsl or .json: it is a plain array, not a texture");
}

void write_files(const std::vector<TableFile>& files) {
  for (const TableFile& file : files) {
    AtomicFile out(file.path);
    out.write(file.bytes);
    out.commit();
  }
}

}  // namespace steradian::fit
