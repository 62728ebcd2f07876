#include "solve/job.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/words.h"
#include "scene/emitters/light_materials.h"
#include "steradian/area_light.h"  // luminance
#include "steradian/error.h"
#include "wrong_use.h"

namespace steradian::app {
namespace {

using namespace eval;

// Splits at a character; no empty text gives no parts.
std::vector<std::string> parts_of(const std::string& text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

const std::string& own_name(const Scene& scene, std::size_t number) {
  const std::size_t area = scene.area_lights.size();
  return number < area ? scene.area_lights[number].name : scene.punctual_lights[number - area].name;
}

std::size_t count_of_lights(const Scene& scene) { return scene.area_lights.size() + scene.punctual_lights.size(); }

// Sets the parameters that a text lists, or all problems of it. member(word): the flag of a parameter; null if there is none.
template <class Member>
void set_parameters(const std::string& list, const std::vector<std::string>& known, Problems& problems, const Place& place,
                    const Member& member) {
  for (const std::string& word : parts_of(list, ',')) {
    if (bool* const value = member(word)) {
      *value = true;
      continue;
    }
    const std::string near = nearest_word(word, known);
    std::string all;
    for (std::size_t i = 0; i < known.size(); ++i) all += (i == 0 ? "" : i + 1 < known.size() ? ", " : " and ") + known[i];
    problems.add(place, eval::quoted(word) + " is not a parameter", near.empty() ? all + " are" : "did you mean " + near + "?");
  }
}

bool* flag_of(const std::string& word, LightFit& fit) {
  return word == "power"      ? &fit.power
         : word == "color"    ? &fit.color
         : word == "position" ? &fit.position
         : word == "rotation" ? &fit.rotation
         : word == "size"     ? &fit.size
         : word == "vertices" ? &fit.vertices
                              : nullptr;
}

bool* flag_of(const std::string& word, MaterialFit& fit) {
  return word == "albedo" ? &fit.albedo : word == "roughness" ? &fit.roughness : nullptr;
}

const std::vector<std::string> kParameters = {"power", "color", "position", "rotation", "size", "vertices"};
const std::vector<std::string> kMaterialParameters = {"albedo", "roughness"};
const std::string kMaterial = "material:";  // before the name of a material

// Calls use(pixel, fraction) for the pixels of a picture within pixel (x, y) of another size.
template <class Use>
void each_within(const Picture& from, const Picture& to, int x, int y, Use use) {
  const double sx = static_cast<double>(from.width) / to.width, sy = static_cast<double>(from.height) / to.height;
  const double x0 = x * sx, x1 = (x + 1) * sx, y0 = y * sy, y1 = (y + 1) * sy;
  for (int j = static_cast<int>(y0); j < std::min(static_cast<int>(std::ceil(y1)), from.height); ++j)
    for (int i = static_cast<int>(x0); i < std::min(static_cast<int>(std::ceil(x1)), from.width); ++i)
      use(from.at(i, j),
          (std::min(x1, i + 1.0) - std::max(x0, static_cast<double>(i))) * (std::min(y1, j + 1.0) - std::max(y0, static_cast<double>(j))));
}

// Means over the pixels that a coarser or finer picture has in the same place.
Picture resampled(const Picture& from, int width, int height) {
  Picture to(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Vec3d sum{};
      double area = 0;
      each_within(from, to, x, y, [&](Vec3f p, double part) {
        sum += static_cast<Vec3d>(p) * part;
        area += part;
      });
      to.at(x, y) = static_cast<Vec3f>(sum / std::max(area, 1e-30));
    }
  return to;
}

// Weights of a resampled picture: 0 where a pixel mixes a lamp with what it lights.
std::vector<float> unmixed(const Picture& from, const Picture& to) {
  double mean = 0;
  for (const Vec3f& p : from.pixels) mean += luminance(static_cast<Vec3d>(p)) / static_cast<double>(from.pixels.size());
  std::vector<float> weights;
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      double least = std::numeric_limits<double>::infinity(), most = 0;
      each_within(from, to, x, y, [&](Vec3f p, double) {
        const double l = luminance(static_cast<Vec3d>(p));
        least = std::min(least, l);
        most = std::max(most, l);
      });
      weights.push_back(most > 4 * mean && least < 0.5 * most ? 0.0f : 1.0f);
    }
  return weights;
}

}  // namespace

std::string SolveJobReader::name_of_light(std::size_t number) const {
  const std::string& own = own_name(scene_, number);
  std::size_t before = 0, same = 0;
  for (std::size_t i = 0; i < count_of_lights(scene_); ++i) {
    if (own_name(scene_, i) != own) continue;
    ++same;
    before += i < number ? 1u : 0u;
  }
  const std::string base = own.empty() ? "light" : own;
  return same > 1 || own.empty() ? base + " " + std::to_string(before + 1) : base;
}

std::vector<std::size_t> SolveJobReader::lights_named(const std::string& glob, const Place& place) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  const std::size_t all = count_of_lights(scene_);
  for (std::size_t i = 0; i < all; ++i) {
    const std::string &own = own_name(scene_, i), name = name_of_light(i);
    if (fnmatch(glob.c_str(), own.c_str(), 0) == 0 || fnmatch(glob.c_str(), name.c_str(), 0) == 0) found.push_back(i);
    if (!own.empty()) names.push_back(name);
  }
  if (!found.empty()) return found;
  std::string hint = all == 0 ? "the scene has no light that shines" : nearest_word(glob, names);
  if (all > 0 && !hint.empty()) hint = "did you mean '" + hint + "'?";
  if (hint.empty()) {
    for (const std::string& name : nearest_beginnings(glob, names, 5)) hint += (hint.empty() ? "there are: " : ", ") + name;
    if (hint.empty()) hint = "the scene's lights have no names: * fits all of them";
  }
  problems_.add(place, "no light is named " + eval::quoted(glob), hint);
  return found;
}

// The lights of one emissive material shine alike: the first leads the others.
void SolveJobReader::add_fits(const std::string& glob, const LightFit& like, const Place& place) {
  for (const std::size_t light : lights_named(glob, place)) {
    const bool fitted = std::any_of(job_.fits.begin(), job_.fits.end(), [&](const LightFit& f) { return f.light == light; });
    if (fitted) {
      problems_.add(place, "light '" + name_of_light(light) + "' is fitted twice", "name each light once");
      continue;
    }
    const int material = scene::material_of_light(scene_, light);
    if (material >= 0) {
      if (std::find(emissive_.begin(), emissive_.end(), material) != emissive_.end()) continue;
      emissive_.push_back(material);
      if (like.position || like.rotation || like.size || like.color)
        problems_.add(place, "light '" + name_of_light(light) + "' is an emissive mesh, whose power and vertices alone are fitted",
                      "name power");
      LightTie tie{{light}};
      for (const std::size_t other : scene::lights_of_material(scene_, material))
        if (other != light) tie.lights.push_back(other);
      if (tie.lights.size() > 1 && like.vertices)
        problems_.add(place, "light '" + name_of_light(light) + "' shares its material with others, so its vertices are not fitted",
                      "name power");
      else if (tie.lights.size() > 1)
        job_.ties.push_back(std::move(tie));
    }
    job_.fits.push_back(like);
    job_.fits.back().light = light;
    job_.fits.back().name = name_of_light(light);
  }
}

void SolveJobReader::add_materials(const std::string& glob, const MaterialFit& like, const Place& place) {
  std::vector<std::string> names;
  bool found = false;
  for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
    const std::string& name = scene_.materials[i].name;
    const bool lamp = std::any_of(scene_.meshes.begin(), scene_.meshes.end(),
                                  [&](const Mesh& mesh) { return mesh.is_light_shape && static_cast<std::size_t>(mesh.material) == i; });
    if (name.empty() || lamp) continue;
    names.push_back(name);
    if (fnmatch(glob.c_str(), name.c_str(), 0) != 0) continue;
    found = true;
    job_.materials.push_back(like);
    job_.materials.back().material = i;
  }
  if (found) return;
  std::string hint = nearest_word(glob, names);
  if (!hint.empty()) hint = "did you mean '" + hint + "'?";
  if (hint.empty())
    for (const std::string& name : nearest_beginnings(glob, names, 5)) hint += (hint.empty() ? "there are: " : ", ") + name;
  problems_.add(place, "no material is named " + eval::quoted(glob), hint.empty() ? "the scene's materials have no names" : hint);
}

void SolveJobReader::add_fit(const std::string& text) {
  const Place top, place = top.in("--fit");
  if (text.starts_with(kMaterial)) {
    const std::string rest = text.substr(kMaterial.size());
    const std::size_t colon = rest.rfind(':');
    MaterialFit fit;
    if (colon == std::string::npos)
      fit.albedo = true;
    else
      set_parameters(rest.substr(colon + 1), kMaterialParameters, problems_, place, [&](const std::string& w) { return flag_of(w, fit); });
    return add_materials(rest.substr(0, colon), fit, place);
  }
  const std::size_t colon = text.rfind(':');
  LightFit fit;
  if (colon == std::string::npos)
    fit.power = true;
  else
    set_parameters(text.substr(colon + 1), kParameters, problems_, place, [&](const std::string& w) { return flag_of(w, fit); });
  add_fits(text.substr(0, colon), fit, place);
}

void SolveJobReader::check_camera(const Place& place, const std::string& name) {
  std::vector<std::string> names;
  for (const Camera& camera : scene_.cameras) {
    if (name.empty() || camera.name == name) return;
    names.push_back(camera.name);
  }
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "there are: " : ", ") + n;
  problems_.add(place, "no camera is named " + eval::quoted(name), all);
}

void SolveJobReader::add_picture(const Place& place, const std::string& path, const std::string& mask, PictureTarget target) {
  try {
    target.picture = read_picture(path);
    const bool resample = defaults_.width > 0 && (target.picture.width != defaults_.width || target.picture.height != defaults_.height);
    const int width = target.picture.width, height = target.picture.height;
    if (resample) {
      Picture other = resampled(target.picture, defaults_.width, defaults_.height);
      target.pixel_weights = unmixed(target.picture, other);
      target.picture = std::move(other);
    }
    if (!mask.empty()) {
      Picture weights = read_picture(mask);
      if (weights.width != width || weights.height != height) {
        problems_.add(place,
                      mask + " is " + std::to_string(weights.width) + "x" + std::to_string(weights.height) + ", the target " +
                          std::to_string(width) + "x" + std::to_string(height),
                      "resample the mask");
        return;
      }
      if (resample) weights = resampled(weights, defaults_.width, defaults_.height);
      target.pixel_weights.resize(weights.pixels.size(), 1.0f);
      for (std::size_t i = 0; i < weights.pixels.size(); ++i) {
        const Vec3f& p = weights.pixels[i];
        target.pixel_weights[i] *= (p.x + p.y + p.z) / 3;
      }
    }
    job_.targets.emplace_back(std::move(target));
  } catch (const Error& e) {
    problems_.add(place, e.what());
  }
}

// Painted pixels want the radiance, and all others none of the part, with less weight.
void SolveJobReader::add_strokes(const Place& place, const std::string& path, Vec3d radiance, double around, PictureTarget target) {
  try {
    Picture strokes = read_picture(path);
    if (defaults_.width > 0) {
      const auto alpha = strokes.layers.find("alpha");
      if (alpha != strokes.layers.end()) strokes.pixels = alpha->second;
      strokes = resampled(strokes, defaults_.width, defaults_.height);
    } else if (const auto alpha = strokes.layers.find("alpha"); alpha != strokes.layers.end()) {
      strokes.pixels = alpha->second;
    }
    target.painted = true;
    target.picture = Picture(strokes.width, strokes.height);
    for (std::size_t i = 0; i < strokes.pixels.size(); ++i) {
      const Vec3f& p = strokes.pixels[i];
      const float painted = std::min(std::max({p.x, p.y, p.z}), 1.0f);
      if (painted > 0.01f) target.picture.pixels[i] = static_cast<Vec3f>(radiance);
      target.pixel_weights.push_back(painted > 0.01f ? painted : static_cast<float>(around));
    }
    job_.targets.emplace_back(std::move(target));
  } catch (const Error& e) {
    problems_.add(place, e.what());
  }
}

void SolveJobReader::add_target(const std::string& picture, const std::string& mask) {
  const Place top;
  check_camera(top.in("--camera"), defaults_.camera);
  PictureTarget target;
  target.camera = defaults_.camera;
  target.space = defaults_.space;
  target.loss = defaults_.loss;
  add_picture(top.in("--target"), picture, mask, std::move(target));
}

SolveJob SolveJobReader::finish() {
  const Place top;
  if (job_.fits.empty() && job_.materials.empty() && !problems_.any())
    problems_.add(top, "nothing to fit", "name lights or materials with --fit, or in the file of --spec");
  if (job_.targets.empty() && !problems_.any()) problems_.add(top, "no target", "give --target, or targets in the file of --spec");
  if (problems_.any()) problems_.raise();
  return std::move(job_);
}

}  // namespace steradian::app
