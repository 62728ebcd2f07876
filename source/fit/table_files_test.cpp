#include "fit/table_files.h"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fit/tables_of_fit.h"
#include "integrals/tables/ggx_tables.h"
#include "integrals/tables/table.h"
#include "paths.h"
#include "scene/table_file.h"
#include "steradian/error.h"
#include "support/gltf_test_file.h"

namespace steradian::fit::table_files_test {
namespace {

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t x;
  std::memcpy(&x, bytes.data() + at, 4);
  return x;
}

}  // namespace

TEST(LtcFiles, DdsHoldsThePairInHalfFloats) {
  const ClassicTable& table = ggx_classic_table();
  const auto files = classic_files(table, "ggx", "out/ltc.dds");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].path, "out/ltc_1.dds");
  EXPECT_EQ(files[1].path, "out/ltc_2.dds");
  for (std::size_t f = 0; f < 2; ++f) {
    const std::string& bytes = files[f].bytes;
    ASSERT_EQ(bytes.size(), 4u + 124 + 20 + 64 * 64 * 8);
    EXPECT_EQ(bytes.substr(0, 4), "DDS ");
    EXPECT_EQ(word(bytes, 4), 124u);
    EXPECT_EQ(word(bytes, 12), 64u);  // height
    EXPECT_EQ(word(bytes, 16), 64u);  // width
    EXPECT_EQ(word(bytes, 76), 32u);  // size of the pixel format
    EXPECT_EQ(bytes.substr(84, 4), "DX10");
    EXPECT_EQ(word(bytes, 128), 10u);  // R16G16B16A16_FLOAT
    const auto& texels = f == 0 ? table.matrix : table.magnitude;
    for (std::size_t k = 0; k < texels.size(); ++k)
      for (std::size_t c = 0; c < 4; ++c) {
        std::uint16_t half;
        std::memcpy(&half, bytes.data() + 148 + (k * 4 + c) * 2, 2);
        ASSERT_EQ(half, half_from_float(texels[k][c])) << k << " " << c;
      }
  }
}

TEST(LtcFiles, ShippedHeadersAreWhatTheWriterWrites) {
  // Tables that are read from the headers give the same text again: nothing is lost.
  const auto again = classic_files(ggx_classic_table(), "ggx", "x.h");
  const auto fresnel = classic_files(ggx_fresnel_table(), "ggx-fresnel", "x.h");
  const auto compact = compact_files(ggx_compact_table(), "ggx", "x.h");
  for (const auto& [name, text] :
       {std::pair{"ggx_classic.h", again[0].bytes}, {"ggx_fresnel.h", fresnel[0].bytes}, {"ggx_compact.h", compact[0].bytes}}) {
    const std::string path = test::kSourceDir + "/tables/" + name;
    std::FILE* file = std::fopen(path.c_str(), "rb");
    ASSERT_NE(file, nullptr) << path;
    std::string found(text.size() + 1, '\0');
    found.resize(std::fread(found.data(), 1, found.size(), file));
    std::fclose(file);
    EXPECT_TRUE(found == text) << path;
  }
}

TEST(LtcFiles, JsonAndExrHoldTheTable) {
  const ClassicTable& table = ggx_classic_table();
  const auto json = nlohmann::json::parse(classic_files(table, "ggx", "x.json")[0].bytes);
  EXPECT_EQ(json["size"], 64);
  EXPECT_EQ(json["matrix"][100][3].get<float>(), table.matrix[100][3]);
  EXPECT_EQ(json["magnitude"][4095][0].get<float>(), table.magnitude[4095][0]);
  const auto compact = nlohmann::json::parse(compact_files(ggx_compact_table(), "ggx", "x.json")[0].bytes);
  EXPECT_EQ(compact["frame"], "mirror");
  EXPECT_EQ(compact["shape"].size(), 256u);
  const auto exr = classic_files(table, "ggx", "x.exr");
  ASSERT_EQ(exr.size(), 2u);
  EXPECT_EQ(word(exr[0].bytes, 0), 20000630u);  // EXR's magic number
}

LtcTable small_fit() {
  FitOptions options;
  options.size = 4;
  options.nodes = 12;
  options.lights = 8;
  options.light_directions = options.magnitude_directions = 256;
  return fit_table(lobe_family("ggx"), options);
}

// Both normalisations contain the same matrices up to a factor, and name themselves.
TEST(LtcFiles, EveryNormalisationIsTheSameLobes) {
  const LtcTable fit = small_fit();
  const auto middle = nlohmann::json::parse(classic_files(classic_table(fit), "ggx", "x.json")[0].bytes);
  const auto last = nlohmann::json::parse(classic_files(classic_table(fit, ClassicNormalisation::last), "ggx", "x.json")[0].bytes);
  EXPECT_FALSE(middle.contains("normalisation"));
  EXPECT_EQ(last["normalisation"], "last");
  for (std::size_t k = 0; k < 16; ++k) {
    const auto a = middle["matrix"][k].get<std::array<double, 4>>(), b = last["matrix"][k].get<std::array<double, 4>>();
    // (xx, zx, xz, zz) over yy, and (xx, zx, xz, yy) over zz; floats round twice.
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(b[c], a[c] / a[3], 2e-7 * std::fabs(b[c])) << k << " " << c;
    EXPECT_NEAR(b[3], 1 / a[3], 2e-7 * std::fabs(b[3])) << k;
    EXPECT_EQ(middle["magnitude"][k], last["magnitude"][k]);
  }
  const std::string header = classic_files(classic_table(fit, ClassicNormalisation::last), "ggx", "x.h")[0].bytes;
  EXPECT_NE(header.find("--normalisation last"), std::string::npos);
}

// `render --table` and `eval` read both; four roundings of floats are between them.
TEST(LtcFiles, BothNormalisationsAreReadAsOneTable) {
  const LtcTable fit = small_fit();
  const auto read = [&](ClassicNormalisation normalisation) {
    const std::string path = scene::test_path("normalisations.json");
    write_files(classic_files(classic_table(fit, normalisation), "ggx", path));
    return scene::read_classic_table(path);
  };
  const ClassicTable middle = read(ClassicNormalisation::middle), last = read(ClassicNormalisation::last);
  EXPECT_EQ(last.normalisation, ClassicNormalisation::middle);
  EXPECT_EQ(middle.magnitude, last.magnitude);
  for (std::size_t k = 0; k < 16; ++k)
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_NEAR(last.matrix[k][c], middle.matrix[k][c], 3e-7f * std::fabs(middle.matrix[k][c])) << k << " " << c;
  // A table that says otherwise is refused.
  const std::string path = scene::test_path("normalisations.json");
  auto files = classic_files(classic_table(fit, ClassicNormalisation::last), "ggx", path);
  files[0].bytes.replace(files[0].bytes.find("\"last\""), 6, "\"first\"");
  write_files(files);
  EXPECT_THROW(scene::read_classic_table(path), Error);
}

TEST(LtcFiles, UnknownEndingsAreRefused) {
  EXPECT_THROW(classic_files(ggx_classic_table(), "ggx", "x.png"), Error);
  EXPECT_THROW(classic_files(ggx_classic_table(), "ggx", "x"), Error);
  EXPECT_THROW(compact_files(ggx_compact_table(), "ggx", "x.dds"), Error);
}

}  // namespace steradian::fit::table_files_test
