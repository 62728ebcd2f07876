#include "scene/gltf/gltf_animation.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf/gltf_accessor.h"

namespace steradian::scene {
namespace {

using Between = AnimationChannel::Between;

constexpr const char* kPointer = "KHR_animation_pointer";

// A pointer that cannot be parsed or names nothing is an error of the file. Defaults of glTF need not be written in the file.
void check_pointer(const AnimationChannel& channel, const Json& json, const JsonCursor& target) {
  try {
    const Json::json_pointer at(channel.pointer);
    if (at.empty()) target.fail("\"" + channel.pointer + "\" names the whole file");
    if (!json.contains(at.parent_pointer())) target.fail("\"" + channel.pointer + "\" names what the file does not have");
    const Json& parent = json.at(at.parent_pointer());
    if (!parent.is_object() || (parent.contains(at.back()) && !parent[at.back()].is_number() && !parent[at.back()].is_array()))
      target.fail("\"" + channel.pointer + "\" is neither a number nor a list of numbers");
  } catch (const nlohmann::json::exception&) {
    target.fail("\"" + channel.pointer + "\" is no JSON pointer");
  }
}

Between between_of(const JsonCursor& sampler) {
  const std::string name = sampler.text("interpolation", "LINEAR");
  if (name == "STEP") return Between::step;
  if (name == "LINEAR") return Between::linear;
  if (name == "CUBICSPLINE") return Between::cubic;
  sampler.at("interpolation").fail("\"" + name + "\" is not known", "LINEAR, STEP or CUBICSPLINE");
}

std::vector<double> numbers_of(const FloatArray& array) {
  std::vector<double> result;
  for (const float v : array.values) result.push_back(static_cast<double>(v));
  return result;
}

void read_sampler(const GltfDocument& document, const JsonCursor& sampler, AnimationChannel& channel) {
  const std::size_t accessors = document.count("accessors");
  channel.between = between_of(sampler);
  const int input = sampler.at("input").as_index(accessors, "accessor"), output = sampler.at("output").as_index(accessors, "accessor");
  const std::uint64_t claimed = checked_count(document, input) + 16 * checked_count(document, output);
  document.budget().take_memory(sampler.place(), "the keys of its animation", claimed * sizeof(double));
  channel.times = numbers_of(read_floats(document, input, "SCALAR"));
  for (std::size_t i = 1; i < channel.times.size(); ++i)
    if (channel.times[i] < channel.times[i - 1])
      sampler.at("input").fail("key " + std::to_string(i) + " is earlier than the one before it");
  const FloatArray values = read_floats(document, output, "SCALAR VEC2 VEC3 VEC4");
  channel.values = numbers_of(values);
  const std::size_t keys = channel.times.size() * (channel.between == Between::cubic ? 3 : 1);
  if (channel.values.empty() || channel.values.size() % keys != 0)
    sampler.at("output").fail(std::to_string(channel.values.size()) + " numbers for " + std::to_string(keys) + " keys");
  channel.width = channel.values.size() / keys;
  channel.number = values.components == 1 && channel.width == 1;
}

// The JSON pointer of a channel's target. Empty for a channel without a node and for an unknown path.
std::string pointer_of(const GltfDocument& document, const JsonCursor& target) {
  const std::string path = target.at("path").as_text();
  if (path == "pointer") {
    const auto extension = find_extension(target, kPointer);
    if (!extension) target.fail("the path is \"pointer\", without " + std::string(kPointer));
    return extension->at("pointer").as_text();
  }
  const int node = target.index("node", document.count("nodes"), "node");
  if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") return {};
  return node < 0 ? std::string() : "/nodes/" + std::to_string(node) + "/" + path;
}

std::size_t width_of(const std::string& pointer) {
  if (pointer.ends_with("/rotation")) return 4;
  return pointer.ends_with("/translation") || pointer.ends_with("/scale") ? 3 : 0;
}

GltfAnimation read_animation(const GltfDocument& document, const Json& json, const JsonCursor& cursor) {
  GltfAnimation animation;
  animation.name = cursor.text("name", "");
  const JsonElements samplers = cursor.at("samplers").elements();
  cursor.at("channels");
  for (const JsonCursor& element : cursor.elements("channels")) {
    const JsonCursor target = element.at("target");
    AnimationChannel channel;
    channel.pointer = pointer_of(document, target);
    if (channel.pointer.empty()) continue;  // ignored, as glTF demands: an extension may give it a meaning
    const int sampler = element.at("sampler").as_index(samplers.size(), "sampler");
    read_sampler(document, samplers[static_cast<std::size_t>(sampler)], channel);
    check_pointer(channel, json, target);
    const bool of_node = channel.pointer.starts_with("/nodes/");
    channel.rotation = of_node && channel.pointer.ends_with("/rotation");
    if (channel.pointer.ends_with("/weights")) channel.number = false;
    if (const std::size_t width = width_of(channel.pointer); of_node && width > 0 && width != channel.width)
      element.fail("has " + std::to_string(channel.width) + " numbers a key, needs " + std::to_string(width));
    animation.duration = std::max(animation.duration, channel.times.back());
    animation.channels.push_back(std::move(channel));
  }
  return animation;
}

void normalize(std::vector<double>& q) {
  double norm = 0;
  for (const double x : q) norm += x * x;
  for (double& x : q) x = norm > 0 ? x / std::sqrt(norm) : (&x == &q.back() ? 1.0 : 0.0);
}

// Interpolates along the shorter arc. Shoemake, "Animating rotation with quaternion curves", 1985.
std::vector<double> slerp(const double* a, const double* b, double s) {
  double cosine = 0;
  for (int i = 0; i < 4; ++i) cosine += a[i] * b[i];
  const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(std::fabs(cosine), 1.0));
  // For nearly equal rotations the chord replaces the arc.
  const double wa = angle < 1e-6 ? 1 - s : std::sin((1 - s) * angle) / std::sin(angle);
  const double wb = angle < 1e-6 ? s : std::sin(s * angle) / std::sin(angle);
  std::vector<double> q(4);
  for (std::size_t i = 0; i < 4; ++i) q[i] = wa * a[i] + sign * wb * b[i];
  normalize(q);
  return q;
}

// Hermite spline of glTF 2.0, appendix C.5, with tangents in units per second.
std::vector<double> hermite(const AnimationChannel& c, std::size_t key, double s, double step) {
  const double s2 = s * s, s3 = s2 * s;
  std::vector<double> result(c.width);
  const double* left = c.values.data() + 3 * c.width * key;
  const double* right = left + 3 * c.width;
  for (std::size_t i = 0; i < c.width; ++i)
    result[i] = (2 * s3 - 3 * s2 + 1) * left[c.width + i] + step * (s3 - 2 * s2 + s) * left[2 * c.width + i] +
                (-2 * s3 + 3 * s2) * right[c.width + i] + step * (s3 - s2) * right[i];
  return result;
}

}  // namespace

std::vector<GltfAnimation> read_animations(const GltfFile& file, const Limits& limits) {
  std::vector<GltfAnimation> result;
  if (!file.json.contains("animations")) return result;
  Budget budget(limits);
  const GltfDocument document = document_of(file, budget);
  for (const JsonCursor& animation : document.root().elements("animations"))
    result.push_back(read_animation(document, file.json, animation));
  return result;
}

std::vector<double> value_at(const AnimationChannel& c, double seconds) {
  const auto after = std::upper_bound(c.times.begin(), c.times.end(), seconds);
  const std::size_t next = static_cast<std::size_t>(after - c.times.begin());
  const std::size_t key = next == 0 ? 0 : next - 1;
  const std::size_t stride = c.between == Between::cubic ? 3 * c.width : c.width, skip = c.between == Between::cubic ? c.width : 0;
  const auto at_key = [&](std::size_t k) { return c.values.begin() + static_cast<std::ptrdiff_t>(k * stride + skip); };
  const std::vector<double> held(at_key(key), at_key(key) + static_cast<std::ptrdiff_t>(c.width));
  if (next == 0 || next == c.times.size() || c.between == Between::step) return held;

  const double step = c.times[next] - c.times[key], s = (seconds - c.times[key]) / step;
  if (c.between == Between::cubic) {
    std::vector<double> result = hermite(c, key, s, step);
    if (c.rotation) normalize(result);
    return result;
  }
  if (c.rotation) return slerp(&*at_key(key), &*at_key(next), s);
  std::vector<double> result(c.width);
  for (std::size_t i = 0; i < c.width; ++i)
    result[i] = (1 - s) * at_key(key)[static_cast<std::ptrdiff_t>(i)] + s * at_key(next)[static_cast<std::ptrdiff_t>(i)];
  return result;
}

Json json_at(const Json& json, const GltfAnimation& animation, double seconds) {
  Json moment = json;
  for (const AnimationChannel& channel : animation.channels) {
    const std::vector<double> value = value_at(channel, seconds);
    const Json::json_pointer at(channel.pointer);
    if (!moment.contains(at.parent_pointer())) continue;  // an edit has removed it
    moment[at] = channel.number ? Json(value[0]) : Json(value);
  }
  return moment;
}

}  // namespace steradian::scene
