#include "image/codecs.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <ImfXdr.h>
#include <algorithm>
#include <cstring>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "steradian/error.h"

namespace steradian::image {
namespace {

const char* const kSuffix[3] = {"R", "G", "B"};

std::string channel_name(const std::string& layer, int c) { return layer.empty() ? kSuffix[c] : layer + "." + kSuffix[c]; }

// A slice of an interleaved layer. OpenEXR wants a non-const pointer even for reading.
Imf::Slice slice(const std::vector<Vec3f>& pixels, int c, int width) {
  const float* base = &pixels.data()->x + c;
  return Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(base)), sizeof(Vec3f),
                    sizeof(Vec3f) * static_cast<std::size_t>(width));
}

void add_layer(Imf::FrameBuffer& frame, const std::string& layer, const std::vector<Vec3f>& pixels, int width) {
  for (int c = 0; c < 3; ++c) frame.insert(channel_name(layer, c), slice(pixels, c, width));
}

// Bytes as OpenEXR reads them; the header's bytes come from a copy.
class MemoryStream : public Imf::IStream {
 public:
  MemoryStream(std::span<const std::uint8_t> header, std::span<const std::uint8_t> bytes, const std::string& name)
      : IStream(name.c_str()), header_(header), bytes_(bytes) {}

  bool read(char to[], int n) override {
    if (n < 0 || static_cast<std::size_t>(n) > bytes_.size() - at_) throw std::runtime_error("the file is cut off");
    const auto end = at_ + static_cast<std::size_t>(n), of_header = std::clamp(header_.size(), at_, end);
    std::memcpy(to, header_.data() + at_, of_header - at_);
    std::memcpy(to + (of_header - at_), bytes_.data() + of_header, end - of_header);
    at_ = end;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override {
    if (to > bytes_.size()) throw std::runtime_error("the file is cut off");
    at_ = static_cast<std::size_t>(to);
  }

 private:
  std::span<const std::uint8_t> header_, bytes_;  // the first bytes of header_ replace those of bytes_
  std::size_t at_ = 0;
};

constexpr std::int64_t kLargestSide = 65536;
constexpr std::uint64_t kLinesInBlock = 256;  // scan lines that the coarsest compression (DWAB) unpacks at once

// Splits a channel's name into the layer and R, G or B; the index is 3 without such a suffix.
std::pair<std::string, int> layer_and_suffix(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::string suffix = dot == std::string::npos ? name : name.substr(dot + 1);
  const int c = suffix == "R" ? 0 : suffix == "G" ? 1 : suffix == "B" ? 2 : 3;
  return {dot == std::string::npos ? "" : name.substr(0, dot), c};
}

// Types of attributes whose readers allocate no more than the attribute's own size: all that a picture needs.
bool is_plain_type(std::string_view type) {
  constexpr std::string_view kPlain[] = {"box2i", "chlist",    "compression", "double",   "float",
                                         "int",   "lineOrder", "string",      "tiledesc", "v2f"};
  return std::find(std::begin(kPlain), std::end(kPlain), type) != std::end(kPlain);
}

// The header's bytes, as OpenEXR may read them. Every attribute's claimed size is covered by the bytes that follow, since OpenEXR allocates
// it before it reads them. The value of an attribute of another type may hold more sizes (lists of texts claim up to 2 GB each). Such an
// attribute gets a type that OpenEXR does not know: OpenEXR then stores the value's bytes and looks no further.
// Attributes: name and type, each ended by 0, four bytes of size, the value; an empty name ends them.
std::vector<std::uint8_t> checked_attributes(std::span<const std::uint8_t> bytes, const std::string& place) {
  if (bytes.size() < 8 || std::memcmp(bytes.data(), "\x76\x2F\x31\x01", 4) != 0)
    throw Error(place, "not an EXR picture: its first bytes are another format's", "name the file by its format");
  std::size_t at = 8;  // magic number and version
  const auto skip_text = [&] {
    const std::size_t begin = at;
    while (at < bytes.size() && bytes[at] != 0) ++at;
    return at++ - begin;
  };
  const auto damaged = [&] { throw Error(place, "the EXR picture's header is cut off or damaged", "save it again"); };
  std::vector<std::pair<std::size_t, std::size_t>> unread;  // positions and lengths of the types
  while (skip_text() > 0) {
    const std::size_t type = at, length = skip_text();
    if (type + length < bytes.size() && !is_plain_type({reinterpret_cast<const char*>(bytes.data()) + type, length}))
      unread.emplace_back(type, length);
    if (at + 4 > bytes.size()) damaged();
    const std::uint64_t size =
        bytes[at] | std::uint64_t{bytes[at + 1]} << 8 | std::uint64_t{bytes[at + 2]} << 16 | std::uint64_t{bytes[at + 3]} << 24;
    at += 4;
    if (size > bytes.size() - at) damaged();
    at += static_cast<std::size_t>(size);
  }
  if (at > bytes.size()) damaged();
  std::vector<std::uint8_t> header(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  for (const auto& [type, length] : unread) std::fill_n(header.begin() + static_cast<std::ptrdiff_t>(type), length, std::uint8_t{'?'});
  return header;
}

// Reads the header alone, before OpenEXR allocates what it claims.
Imf::Header checked_header(MemoryStream& stream, const std::string& place, Budget& budget) {
  int magic = 0, version = 0;
  Imf::Xdr::read<Imf::StreamIO>(stream, magic);
  Imf::Xdr::read<Imf::StreamIO>(stream, version);
  if (Imf::isMultiPart(version) || Imf::isNonImage(version))
    throw Error(place, "the EXR picture has several parts or deep pixels", "save it as one flat part");
  Imf::Header header;
  header.readFrom(stream, version);
  const auto window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1, height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    throw Error(place, "the picture claims " + std::to_string(width) + " x " + std::to_string(height) + " pixels; a side may have " +
                           std::to_string(kLargestSide));
  std::set<std::string> layers{""};
  std::uint64_t channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c, ++channels) {
    const auto [layer, suffix] = layer_and_suffix(c.name());
    if (suffix < 3) layers.insert(layer);
    if (std::string(c.name()) == "A") layers.insert("alpha");
  }
  const auto pixels = static_cast<std::uint64_t>(width * height);
  const std::uint64_t lines = header.hasTileDescription() ? header.tileDescription().ySize : kLinesInBlock;
  // A wrong tile size could overflow the product below.
  if (lines > kLargestSide) throw Error(place, "the EXR picture claims tiles of " + std::to_string(lines) + " lines");
  budget.take_memory(place, "the picture's pixels", sizeof(Vec3f) * pixels * layers.size());
  budget.take_memory(place, "the picture's blocks of lines", 2 * sizeof(float) * channels * static_cast<std::uint64_t>(width) * lines);
  return header;
}

Picture read_pixels(MemoryStream& stream, const Imath::Box2i& window, const std::string& place) {
  Imf::InputFile file(stream, 0);
  Picture picture(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
  Imf::FrameBuffer frame;
  const auto shifted = [&](const std::vector<Vec3f>& pixels, int c) {
    Imf::Slice s = slice(pixels, c, picture.width);
    s.base -= static_cast<std::int64_t>(sizeof(Vec3f)) * (window.min.x + std::int64_t{picture.width} * window.min.y);
    return s;
  };
  const Imf::ChannelList& channels = file.header().channels();
  std::vector<Vec3f>* alpha = nullptr;
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    const auto [layer, suffix] = layer_and_suffix(c.name());
    if (std::string(c.name()) == "A") {
      alpha = &picture.layers["alpha"];
      alpha->resize(picture.pixels.size());
      frame.insert("A", shifted(*alpha, 0));
      continue;
    }
    if (suffix == 3) {
      if (std::string(c.name()) != "Y") picture.unread.push_back(c.name());
      continue;
    }
    std::vector<Vec3f>& pixels = layer.empty() ? picture.pixels : picture.layers[layer];
    pixels.resize(picture.pixels.size());
    frame.insert(c.name(), shifted(pixels, suffix));
  }
  const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
  if (!has("R") && !has("G") && !has("B") && !has("Y")) {
    std::string names;
    for (auto c = channels.begin(); c != channels.end() && names.size() < 400; ++c)
      names += (names.empty() ? "" : ", ") + std::string(c.name());
    throw Error(place, "the EXR picture has none of the channels R, G, B and Y; it has " + (names.empty() ? "none" : names),
                "save one layer of it without a layer's name");
  }
  const bool grey = !has("R") && !has("G") && !has("B");
  if (grey && channels.findChannel("Y") != nullptr) frame.insert("Y", shifted(picture.pixels, 0));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  if (grey)
    for (Vec3f& p : picture.pixels) p.y = p.z = p.x;
  if (alpha != nullptr)
    for (Vec3f& p : *alpha) p.y = p.z = p.x;
  for (auto a = file.header().begin(); a != file.header().end(); ++a)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) picture.metadata[a.name()] = text->value();
  return picture;
}

}  // namespace

// OpenEXR counts the threads beside that of the caller, which waits for them.
void encode_exr_with(int threads) { Imf::setGlobalThreadCount(threads > 1 ? threads : 0); }

std::string encode_exr(const Picture& picture) {
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, value] : picture.metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer frame;
  add_layer(frame, "", picture.pixels, picture.width);
  for (const auto& [layer, pixels] : picture.layers) {
    if (layer == "alpha")
      frame.insert("A", slice(pixels, 0, picture.width));
    else
      add_layer(frame, layer, pixels, picture.width);
  }
  for (auto s = frame.begin(); s != frame.end(); ++s) header.channels().insert(s.name(), Imf::Channel(Imf::FLOAT));
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(picture.height);
  }
  return stream.str();
}

Picture decode_exr(std::span<const std::uint8_t> bytes, const std::string& place, Budget& budget) {
  try {
    const std::vector<std::uint8_t> checked = checked_attributes(bytes, place);
    MemoryStream stream(checked, bytes, place);
    const Imf::Header header = checked_header(stream, place, budget);
    stream.seekg(0);
    return read_pixels(stream, header.dataWindow(), place);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(place, std::string("not a readable EXR picture: ") + e.what(), "save it again");
  }
}

}  // namespace steradian::image
