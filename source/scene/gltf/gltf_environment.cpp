#include "scene/gltf/gltf_environment.h"

#include <algorithm>
#include <cmath>

namespace steradian::scene {
namespace {

constexpr std::size_t kFaces = 6;

struct LightTurn {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // the light's axes in the scene
};

LightTurn read_rotation(const JsonCursor& light) {
  const auto rotation = light.find("rotation");
  if (!rotation) return {};
  auto q = rotation->as_numbers<4>();
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(norm > 1e-6)) rotation->fail("is no rotation", "a unit quaternion x, y, z, w");
  for (double& c : q) c /= norm;
  const Vec3d v{q[0], q[1], q[2]};
  const auto turned = [&](Vec3d a) { return a + cross(v, cross(v, a) + a * q[3]) * 2.0; };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

// A face of the cube and the place on it, from 0 to 1, as viewed from inside: x to the right, y upwards.
struct FacePlace {
  std::size_t face;
  double u, v;
};
FacePlace face_place(Vec3d d) {
  const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  const auto at = [](std::size_t face, double right, double up, double depth) {
    return FacePlace{face, 0.5 + 0.5 * right / depth, 0.5 - 0.5 * up / depth};
  };
  if (x >= y && x >= z) return d.x > 0 ? at(0, d.z, d.y, x) : at(1, -d.z, d.y, x);
  if (y >= z) return d.y > 0 ? at(2, -d.x, -d.z, y) : at(3, -d.x, d.z, y);
  return d.z > 0 ? at(4, -d.x, d.y, z) : at(5, d.x, d.y, z);
}

// Decodes RGBD: the colours divided by alpha. Pictures without alpha have alpha 1.
Vec3d texel(const Image& image, int i, int j) {
  const std::uint8_t* p =
      image.rgba.data() + 4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(i));
  const double alpha = std::max<int>(p[3], 1) / 255.0;
  return Vec3d{static_cast<double>(linear_from_srgb8(p[0])), static_cast<double>(linear_from_srgb8(p[1])),
               static_cast<double>(linear_from_srgb8(p[2]))} /
         alpha;
}

Vec3d linear(const Image& image, double u, double v) {
  const double x = std::clamp(u * image.width - 0.5, 0.0, image.width - 1.0),
               y = std::clamp(v * image.height - 0.5, 0.0, image.height - 1.0);
  const int i = std::min(static_cast<int>(x), std::max(image.width - 2, 0)),
            j = std::min(static_cast<int>(y), std::max(image.height - 2, 0));
  const int right = std::min(i + 1, image.width - 1), down = std::min(j + 1, image.height - 1);
  const double fx = x - i, fy = y - j;
  return (texel(image, i, j) * (1 - fx) + texel(image, right, j) * fx) * (1 - fy) +
         (texel(image, i, down) * (1 - fx) + texel(image, right, down) * fx) * fy;
}

std::array<const Image*, kFaces> read_faces(const JsonCursor& light, GltfTextures& textures) {
  const JsonElements levels = light.elements("specularImages");
  if (levels.empty()) light.fail("\"specularImages\" is missing or empty");
  const JsonElements faces = levels[0].elements();
  if (faces.size() != kFaces) levels[0].fail("needs the 6 faces of a cube, has " + std::to_string(faces.size()));
  std::array<int, kFaces> loaded;
  for (std::size_t i = 0; i < kFaces; ++i) loaded[i] = textures.image(faces[i]);
  std::array<const Image*, kFaces> images;
  for (std::size_t i = 0; i < kFaces; ++i) {
    if (loaded[i] < 0) faces[i].fail("is a picture of a format that is not read", "save it as PNG or JPEG");
    images[i] = &textures.images()[static_cast<std::size_t>(loaded[i])];  // only now: loading an image may move the others
    if (images[i]->width != images[i]->height || images[i]->width != images[0]->width)
      faces[i].fail("the faces of a cube are squares of one size");
  }
  return images;
}

}  // namespace

std::shared_ptr<const Environment> read_image_based_light(const GltfDocument& document, GltfTextures& textures) {
  if (document.count("scenes") == 0) return nullptr;
  const int chosen = document.root().index("scene", document.count("scenes"), "scene");
  const auto reference = find_extension(document.object("scenes", std::max(chosen, 0)), "EXT_lights_image_based");
  if (!reference) return nullptr;
  const auto root = find_extension(document.root(), "EXT_lights_image_based");
  const JsonElements lights = root ? root->elements("lights") : JsonElements{};
  const JsonCursor light = lights[static_cast<std::size_t>(reference->at("light").as_index(lights.size(), "light"))];

  const LightTurn turn = read_rotation(light);
  const double intensity = light.number("intensity", 1, 0, 1e12);
  Environment environment;
  environment.name = light.text("name", "EXT_lights_image_based");

  IrradianceCoefficients irradiance{{}, turn.x, turn.y, turn.z};
  const JsonElements rows = light.at("irradianceCoefficients").elements();
  if (rows.size() != irradiance.rgb.size()) light.at("irradianceCoefficients").fail("needs 9 rows of 3 numbers");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto c = rows[i].as_numbers<3>();
    irradiance.rgb[i] = Vec3d{c[0], c[1], c[2]} * intensity;
    if (!is_finite(static_cast<Vec3f>(irradiance.rgb[i]))) rows[i].fail("leaves the range of numbers");
  }
  environment.irradiance = irradiance;

  const auto faces = read_faces(light, textures);
  const int side = faces[0]->width;
  document.budget().take_memory(light.place(), "its map",
                                sizeof(Vec3f) * 8 * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side));
  document.budget().take_work(light.place(), "its map", 100 * 8 * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side));
  environment.map = Picture(4 * side, 2 * side);
  for (int j = 0; j < 2 * side; ++j)
    for (int i = 0; i < 4 * side; ++i) {
      const Vec3d d = direction_of({(i + 0.5) / (4 * side), (j + 0.5) / (2 * side)});
      const FacePlace place = face_place({dot(d, turn.x), dot(d, turn.y), dot(d, turn.z)});
      environment.map.at(i, j) = static_cast<Vec3f>(linear(*faces[place.face], place.u, place.v) * intensity);
    }
  return std::make_shared<const Environment>(std::move(environment));
}

}  // namespace steradian::scene
