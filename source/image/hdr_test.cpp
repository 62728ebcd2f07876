// Tests of Radiance pictures, whole and damaged.
#include "image/codecs.h"

#include <gtest/gtest.h>
#include <random>

#include "steradian/error.h"

namespace steradian::image::hdr_test {
namespace {

Picture decoded(const std::string& file, const Limits& limits = {}) {
  Budget budget(limits);
  return decode_hdr({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, "map.hdr", budget);
}

std::string refusal(const std::string& file, const Limits& limits = {}) {
  try {
    decoded(file, limits);
  } catch (const Error& e) {
    EXPECT_EQ(e.place(), "map.hdr");
    return e.what();
  }
  return "";
}

std::string header(int width, int height, const std::string& more = "") {
  return "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n" + more + "\n-Y " + std::to_string(height) + " +X " + std::to_string(width) +
         "\n";
}

const std::string kHalf("\x80\x40\x20\x80", 4);  // 0.5, 0.25, 0.125

// Sixteen columns, two rows: every channel is one run of 16.
std::string in_runs() {
  const std::string row = std::string("\x02\x02\x00\x10", 4) + "\x90\x80" + "\x90\x40" + "\x90\x20" + "\x90\x80";
  return header(16, 2) + row + row;
}

}  // namespace

TEST(Hdr, ReadsFlatRows) {
  const Picture p = decoded(header(2, 1) + kHalf + std::string("\xff\x00\x00\x00", 4));
  ASSERT_EQ(p.width, 2);
  EXPECT_EQ(p.at(0, 0), (Vec3f{0.5f, 0.25f, 0.125f}));
  EXPECT_EQ(p.at(1, 0), (Vec3f{0, 0, 0}));
}

TEST(Hdr, ReadsRunsAndLiterals) {
  const Picture p = decoded(in_runs());
  for (const Vec3f& x : p.pixels) EXPECT_EQ(x, (Vec3f{0.5f, 0.25f, 0.125f}));
  // Red as 4 literals and a run of 4.
  const std::string row =
      std::string("\x02\x02\x00\x08", 4) + std::string("\x04\x00\x40\x80\xc0\x84\x80", 7) + std::string("\x88\x00\x88\x00\x88\x81", 6);
  const Picture q = decoded(header(8, 1) + row);
  EXPECT_EQ(q.at(1, 0).x, 0.5f);
  EXPECT_EQ(q.at(3, 0).x, 1.5f);
  EXPECT_EQ(q.at(7, 0).x, 1.0f);
}

TEST(Hdr, DividesTheExposureOut) {
  const Picture p = decoded(header(1, 1, "EXPOSURE=4\nEXPOSURE=0.5\n") + kHalf);
  EXPECT_EQ(p.at(0, 0).x, 0.25f);
}

TEST(Hdr, RefusesWhatIsNoWholePicture) {
  EXPECT_NE(refusal("").find("cut off"), std::string::npos);
  EXPECT_NE(refusal("\x89PNG\r\n\x1a\n").find("not a Radiance picture"), std::string::npos);
  EXPECT_NE(refusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + kHalf).find("xyze"), std::string::npos);
  EXPECT_NE(refusal("#?RADIANCE\n\n+X 1 +Y 1\n" + kHalf).find("rows from the top"), std::string::npos);
  EXPECT_NE(refusal(header(1, 1, "EXPOSURE=-1\n") + kHalf).find("exposure"), std::string::npos);
  EXPECT_NE(refusal(header(0, 5) + kHalf).find("no pixels"), std::string::npos);
  EXPECT_NE(refusal(header(-1, 5) + kHalf).find("a side may have"), std::string::npos);
  EXPECT_NE(refusal("#?RADIANCE\n" + std::string(100000, 'x')).find("line without an end"), std::string::npos);
  EXPECT_NE(refusal(header(8, 1) + std::string("\x02\x02\x00\x09", 4) + std::string(40, 'x')).find("another width"), std::string::npos);
  EXPECT_NE(refusal(header(8, 1) + std::string("\x02\x02\x00\x08\xff\x01", 6) + std::string(40, 'x')).find("leaves its row"),
            std::string::npos);
  EXPECT_NE(refusal(header(8, 1) + std::string("\x02\x02\x00\x08\x00\x01", 6) + std::string(40, 'x')).find("leaves its row"),
            std::string::npos);
}

TEST(Hdr, RefusesALargeSizeBeforeMemoryIsTaken) {
  EXPECT_NE(refusal(header(60000, 60000) + kHalf).find("more than may be read"), std::string::npos);
  EXPECT_NE(refusal(header(16000, 16000) + kHalf).find("asks for more bytes"), std::string::npos);
  EXPECT_NE(refusal(header(30000, 8000) + std::string("\x02\x02\x75\x30", 4)).find("asks for more bytes"), std::string::npos);
  std::string whole = header(1000, 1000) + std::string(4'000'000, '\x80');
  EXPECT_NE(refusal(whole, Limits{.memory = 1'000'000}).find("max-memory"), std::string::npos);
}

TEST(Hdr, DamagedFilesAreRefusedOrRead) {
  std::mt19937 random(1);
  const std::string good = in_runs();
  for (int i = 0; i < 20000; ++i) {
    std::string bad = good;
    for (unsigned k = 0; k <= random() % 4; ++k) bad[random() % bad.size()] = static_cast<char>(random());
    if (random() % 4 == 0) bad.resize(random() % bad.size());
    try {
      for (const Vec3f& p : decoded(bad).pixels) ASSERT_TRUE(is_finite(p));
    } catch (const Error&) {
    }
  }
}

}  // namespace steradian::image::hdr_test
