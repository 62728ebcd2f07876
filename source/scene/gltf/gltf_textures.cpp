#include "scene/gltf/gltf_textures.h"

#include <chrono>
#include <cmath>

#include "image/codecs.h"

namespace steradian::scene {
namespace {

constexpr int kNotLoaded = -2, kNotRead = -1;
// The limit is 1 GiB of texels for all images together, because compressed pictures can claim a million times their size.
constexpr std::size_t kMaxTexels = std::size_t{1} << 28;
constexpr std::size_t kMaxImageTexels = std::size_t{1} << 26;  // 8192 x 8192

Wrap wrap_of(const JsonCursor& sampler, const char* key) {
  constexpr std::int64_t kClamp = 33071, kMirrored = 33648, kRepeat = 10497;
  switch (sampler.integer(key, kRepeat, 0, 65535)) {
    case kClamp: return Wrap::clamp_to_edge;
    case kMirrored: return Wrap::mirrored_repeat;
    case kRepeat: return Wrap::repeat;
    default: sampler.at(key).fail(sampler.at(key).value().dump() + " is not a wrap mode", "10497 repeats, 33071 clamps, 33648 mirrors");
  }
}

}  // namespace

GltfTextures::GltfTextures(const GltfDocument& document, std::vector<Image>& images, Warnings& warnings,
                           std::shared_ptr<DecodedPictures> kept)
    : document_(document),
      images_(images),
      warnings_(warnings),
      kept_(std::move(kept)),
      loaded_(document.count("images"), kNotLoaded),
      texels_left_(kMaxTexels) {}

void GltfTextures::apply_sampler(TextureUse& use, const JsonCursor& sampler) const {
  use.wrap_u = wrap_of(sampler, "wrapS");
  use.wrap_v = wrap_of(sampler, "wrapT");
  constexpr std::int64_t kNearest = 9728, kLinear = 9729;
  const std::int64_t filter = sampler.integer("magFilter", kLinear, 0, 65535);
  if (filter != kNearest && filter != kLinear)
    sampler.at("magFilter").fail(std::to_string(filter) + " is not a filter", "9728 is nearest, 9729 linear");
  use.filter = filter == kNearest ? Filter::nearest : Filter::linear;
}

// uv' = translation * rotation * scale * uv. The rotation is counter-clockwise in the picture (v points down).
void GltfTextures::apply_transform(TextureUse& use, const JsonCursor& transform) const {
  const auto pair = [&](const char* key, double otherwise) {
    const auto member = transform.find(key);
    return member ? member->as_numbers<2>() : std::array<double, 2>{otherwise, otherwise};
  };
  const auto offset = pair("offset", 0), scale = pair("scale", 1);
  const double angle = transform.number("rotation", 0);
  const double c = std::cos(angle), s = std::sin(angle);
  const double uv[6] = {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
  for (int i = 0; i < 6; ++i) use.uv[i] = static_cast<float>(uv[i]);
  use.texcoord = static_cast<int>(transform.integer("texCoord", use.texcoord, 0, 1 << 20));
}

int GltfTextures::load_image(int gltf_image) {
  if (kept_ != nullptr)
    if (const auto known = kept_->images.find(gltf_image); known != kept_->images.end()) {
      document_.budget().take_memory(document_.object("images", gltf_image).place(), "its pixels", known->second.rgba.size());
      images_.push_back(known->second);
      return static_cast<int>(images_.size()) - 1;
    }
  const JsonCursor image = document_.object("images", gltf_image);
  const std::string type = image.text("mimeType", "");
  if (!type.empty() && type != "image/png" && type != "image/jpeg") {
    warnings_.not_supported("textures of type " + type);
    return kNotRead;
  }
  std::span<const std::uint8_t> bytes;
  std::string place = image.place();
  if (const auto uri = image.find("uri")) {
    bytes = read_uri(document_, *uri);
    if (!uri->as_text().starts_with("data:")) place += ": " + uri->as_text();
  } else if (image.has("bufferView")) {
    bytes = view_bytes(document_, image.index("bufferView", document_.count("bufferViews"), "bufferView"));
  } else {
    image.fail("has neither \"uri\" nor \"bufferView\"");
  }
  switch (image::format_of(bytes)) {
    case image::ImageFormat::known_but_not_read: warnings_.not_supported("textures in KTX, WebP or DDS"); return kNotRead;
    case image::ImageFormat::unknown: throw Error(place, "the picture is neither PNG nor JPEG", "save it as PNG");
    case image::ImageFormat::png:
    case image::ImageFormat::jpeg: break;
  }
  if (!type.empty() && type != (image::format_of(bytes) == image::ImageFormat::png ? "image/png" : "image/jpeg"))
    warnings_.count("a picture's mimeType is not what its bytes are", place);
  const auto start = std::chrono::steady_clock::now();
  Image decoded = image::decode_image(bytes, place, std::min(texels_left_, kMaxImageTexels), document_.budget());
  decoding_ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  texels_left_ -= decoded.rgba.size() / 4;
  decoded.name = image.text("name", image.text("uri", "").starts_with("data:") ? "" : image.text("uri", ""));
  if (kept_ != nullptr) kept_->images.emplace(gltf_image, decoded);
  images_.push_back(std::move(decoded));
  return static_cast<int>(images_.size()) - 1;
}

int GltfTextures::scene_image(int gltf_image) {
  int& loaded = loaded_[static_cast<std::size_t>(gltf_image)];
  if (loaded == kNotLoaded) loaded = load_image(gltf_image);
  return loaded;
}

TextureUse GltfTextures::use(const JsonCursor& owner, const char* key, ColorSpace space) {
  TextureUse result;
  result.color_space = space;
  const auto info = owner.find(key);
  if (!info) return result;
  const int index = info->at("index").as_index(document_.count("textures"), "texture");
  const JsonCursor texture = document_.object("textures", index);
  result.texcoord = static_cast<int>(info->integer("texCoord", 0, 0, 1 << 20));
  const std::string name = key;
  const double scale = name.ends_with("ormalTexture") ? info->number("scale", 1) : info->number("strength", 1);
  result.scale = static_cast<float>(scale);
  if (const int sampler = texture.index("sampler", document_.count("samplers"), "sampler"); sampler >= 0)
    apply_sampler(result, document_.object("samplers", sampler));
  if (const auto transform = find_extension(*info, "KHR_texture_transform")) apply_transform(result, *transform);
  const int image = texture.index("source", document_.count("images"), "image");
  if (image < 0) {
    warnings_.not_supported("textures without a PNG or JPEG source");
    return result;
  }
  if (result.texcoord > 1) {
    warnings_.not_supported("texture coordinate sets above 1");
    return result;
  }
  result.image = scene_image(image);
  return result;
}

}  // namespace steradian::scene
