#include "image/codecs.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "steradian/error.h"

namespace steradian::image {
namespace {

// Pixels of the largest picture that render creates, 16384 x 16384.
constexpr std::size_t kMostPixels = std::size_t{1} << 28;
constexpr std::size_t kLargestHdrSide = 65536;
constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kShortestRuns = 8, kLongestRuns = 32767;  // widths that may be stored in runs

using Rgbe = std::array<std::uint8_t, 4>;

class HdrReader {
 public:
  HdrReader(std::span<const std::uint8_t> bytes, const std::string& place) : bytes_(bytes), place_(place) {}

  [[noreturn]] void damaged(const std::string& what) const { throw Error(place_, "the Radiance picture " + what, "save it again"); }

  std::size_t left() const { return bytes_.size() - at_; }
  std::uint8_t peek(std::size_t ahead) const { return ahead < left() ? bytes_[at_ + ahead] : 0; }
  void skip(std::size_t n) { at_ += n; }
  std::uint8_t byte() {
    if (left() == 0) damaged("is cut off");
    return bytes_[at_++];
  }

  std::string line() {
    std::string text;
    while (true) {
      const auto c = static_cast<char>(byte());
      if (c == '\n') return text;
      if (text.size() == kLongestLine) damaged("has a header line without an end");
      text += c;
    }
  }

 private:
  std::span<const std::uint8_t> bytes_;
  const std::string& place_;
  std::size_t at_ = 0;
};

struct Header {
  std::size_t width = 0, height = 0;
  double exposure = 1;  // factor by which the pixels have been multiplied
};

Header read_header(HdrReader& in, const std::string& place) {
  if (!in.line().starts_with("#?"))
    throw Error(place, "is not a Radiance picture: its first bytes are another format's", "name the file by its format");
  Header header;
  while (true) {
    const std::string text = in.line();
    if (text.empty()) break;
    if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe")
      throw Error(place, "holds the pixels as " + text.substr(7), "only 32-bit_rle_rgbe is read");
    if (text.starts_with("EXPOSURE=")) {
      const double factor = std::strtod(text.c_str() + 9, nullptr);
      if (!(factor > 1e-30 && factor < 1e30)) in.damaged("has an exposure that is no positive number");
      header.exposure *= factor;
    }
  }
  if (!(header.exposure > 1e-30 && header.exposure < 1e30)) in.damaged("has an exposure out of range");
  const std::string size = in.line();
  unsigned long width = 0, height = 0;
  int used = 0;
  if (size.size() > 40 || std::sscanf(size.c_str(), "-Y %lu +X %lu%n", &height, &width, &used) != 2 ||
      static_cast<std::size_t>(used) != size.size())
    throw Error(place, "the Radiance picture's size reads '" + size.substr(0, 40) + "'",
                "only -Y HEIGHT +X WIDTH, rows from the top, is read");
  header.width = width;
  header.height = height;
  return header;
}

bool in_runs(const HdrReader& in, std::size_t width) {
  return width >= kShortestRuns && width <= kLongestRuns && in.peek(0) == 2 && in.peek(1) == 2 && (in.peek(2) & 0x80) == 0;
}

// The fewest bytes that a row can occupy: four for its start, and two for every 127 values of a channel.
std::size_t fewest_bytes_of_row(const HdrReader& in, std::size_t width) {
  return in_runs(in, width) ? 4 + 4 * 2 * ((width + 126) / 127) : 4 * width;
}

// Reads one channel after the other; a count above 128 repeats the next byte.
void read_runs(HdrReader& in, std::vector<Rgbe>& row) {
  if ((std::size_t{in.peek(2)} << 8 | in.peek(3)) != row.size()) in.damaged("has a row of another width");
  in.skip(4);
  for (std::size_t channel = 0; channel < 4; ++channel)
    for (std::size_t x = 0; x < row.size();) {
      const std::size_t code = in.byte(), count = code > 128 ? code - 128 : code;
      if (count == 0 || count > row.size() - x) in.damaged("has a run that leaves its row");
      const bool repeats = code > 128;
      std::uint8_t value = repeats ? in.byte() : 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (!repeats) value = in.byte();
        row[x++][channel] = value;
      }
    }
}

void read_flat(HdrReader& in, std::vector<Rgbe>& row) {
  for (Rgbe& pixel : row) {
    for (std::uint8_t& value : pixel) value = in.byte();
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) in.damaged("is stored in the run lengths of before 1991, which are not read");
  }
}

Vec3f radiance_of(const Rgbe& p, double scale) {
  if (p[3] == 0) return {};
  const double unit = std::ldexp(scale, p[3] - (128 + 8));
  return static_cast<Vec3f>(Vec3d{p[0] * unit, p[1] * unit, p[2] * unit});
}

}  // namespace

Picture decode_hdr(std::span<const std::uint8_t> bytes, const std::string& place, Budget& budget) {
  HdrReader in(bytes, place);
  const Header header = read_header(in, place);
  if (header.width > kLargestHdrSide || header.height > kLargestHdrSide)
    throw Error(place, "the picture claims " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                           " pixels; a side may have " + std::to_string(kLargestHdrSide));
  const std::size_t pixels = checked_texels(header.width, header.height, place, kMostPixels);
  if (in.left() / fewest_bytes_of_row(in, header.width) < header.height) in.damaged("is cut off: its size asks for more bytes");
  budget.take_memory(place, "the picture's pixels", sizeof(Vec3f) * pixels);

  Picture picture(static_cast<int>(header.width), static_cast<int>(header.height));
  std::vector<Rgbe> row(header.width);
  for (int y = 0; y < picture.height; ++y) {
    if (in_runs(in, header.width))
      read_runs(in, row);
    else
      read_flat(in, row);
    for (int x = 0; x < picture.width; ++x) picture.at(x, y) = radiance_of(row[static_cast<std::size_t>(x)], 1 / header.exposure);
  }
  return picture;
}

}  // namespace steradian::image
