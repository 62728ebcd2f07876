#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include "steradian/error.h"

namespace steradian {
namespace {

const char* const kSuffix[3] = {"R", "G", "B"};

std::string channel_name(const std::string& layer, int c) { return layer.empty() ? kSuffix[c] : layer + "." + kSuffix[c]; }

// A slice of an interleaved layer. OpenEXR wants a non-const pointer also where it only reads.
Imf::Slice slice(const std::vector<Vec3f>& pixels, int c, int width) {
  const float* base = &pixels.data()->x + c;
  return Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(base)), sizeof(Vec3f),
                    sizeof(Vec3f) * static_cast<std::size_t>(width));
}

void add_layer(Imf::FrameBuffer& frame, const std::string& layer, const std::vector<Vec3f>& pixels, int width) {
  for (int c = 0; c < 3; ++c) frame.insert(channel_name(layer, c), slice(pixels, c, width));
}

}  // namespace

std::string encode_exr(const Picture& picture) {
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, value] : picture.metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer frame;
  add_layer(frame, "", picture.pixels, picture.width);
  for (const auto& [layer, pixels] : picture.layers) add_layer(frame, layer, pixels, picture.width);
  for (auto s = frame.begin(); s != frame.end(); ++s) header.channels().insert(s.name(), Imf::Channel(Imf::FLOAT));
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(picture.height);
  }
  return stream.str();
}

Picture decode_exr(const std::string& path) {
  try {
    Imf::InputFile file(path.c_str());
    const auto window = file.header().dataWindow();
    const long width = static_cast<long>(window.max.x) - window.min.x + 1;
    const long height = static_cast<long>(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > 65536 || height > 65536 || width * height > (1L << 28))
      throw Error(path, "the picture claims " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    Picture picture(static_cast<int>(width), static_cast<int>(height));
    Imf::FrameBuffer frame;
    const auto shifted = [&](const std::vector<Vec3f>& pixels, int c) {
      Imf::Slice s = slice(pixels, c, picture.width);
      s.base -= static_cast<long>(sizeof(Vec3f)) * (window.min.x + width * window.min.y);
      return s;
    };
    for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
      const std::string name = c.name();
      const std::size_t dot = name.rfind('.');
      const std::string suffix = dot == std::string::npos ? name : name.substr(dot + 1);
      const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
      for (int k = 0; k < 3; ++k) {
        if (suffix != kSuffix[k]) continue;
        std::vector<Vec3f>& pixels = layer.empty() ? picture.pixels : picture.layers[layer];
        pixels.resize(picture.pixels.size());
        frame.insert(name, shifted(pixels, k));
      }
    }
    if (file.header().channels().findChannel("Y") != nullptr && file.header().channels().findChannel("R") == nullptr)
      frame.insert("Y", shifted(picture.pixels, 0));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    if (file.header().channels().findChannel("R") == nullptr)
      for (Vec3f& p : picture.pixels) p.y = p.z = p.x;
    for (auto a = file.header().begin(); a != file.header().end(); ++a)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
        picture.metadata[a.name()] = text->value();
    return picture;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    throw Error(path, std::string("not a readable EXR picture: ") + e.what());
  }
}

}  // namespace steradian
