#include "scene/gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/words.h"

namespace steradian::scene {
namespace {

constexpr std::int64_t kMaxInteger = std::int64_t{1} << 53;
// An accessor without a bufferView is all zeros and costs the file nothing, so the count that it may claim is bounded.
constexpr std::size_t kMaxZeros = std::size_t{1} << 24;

enum Component { kByte = 5120, kUnsignedByte, kShort, kUnsignedShort, kUnsignedInt = 5125, kFloat };

std::size_t bytes_of(int component) {
  switch (component) {
    case kByte:
    case kUnsignedByte: return 1;
    case kShort:
    case kUnsignedShort: return 2;
    case kUnsignedInt:
    case kFloat: return 4;
    default: return 0;
  }
}

int components_of(const JsonCursor& type) {
  const std::string name = type.as_text();
  if (name == "SCALAR") return 1;
  if (name == "VEC2") return 2;
  if (name == "VEC3") return 3;
  if (name == "VEC4" || name == "MAT2") return 4;
  if (name == "MAT3") return 9;
  if (name == "MAT4") return 16;
  type.fail("\"" + name + "\" is not an accessor type");
}

struct Elements {
  const std::uint8_t* data = nullptr;  // null: zeros
  std::size_t stride = 0;
};

struct AccessorLayout {
  std::size_t count = 0;
  int components = 0;
  int component = kFloat;
  bool normalized = false;
  std::size_t element_bytes = 0;
};

int component_type(const JsonCursor& owner) {
  const JsonCursor value = owner.at("componentType");
  const auto component = static_cast<int>(value.as_integer(0, 1 << 20));
  if (bytes_of(component) == 0) value.fail(std::to_string(component) + " is not a component type");
  return component;
}

// Returns `count` elements of a bufferView, after checking that the view holds them all.
Elements checked_elements(const GltfDocument& document, const JsonCursor& owner, std::size_t count, std::size_t element_bytes,
                          bool strided) {
  const int view = owner.at("bufferView").as_index(document.count("bufferViews"), "bufferView");
  const auto bytes = view_bytes(document, view);
  std::size_t stride = element_bytes;
  if (strided) {
    const JsonCursor view_json = document.object("bufferViews", view);
    stride = static_cast<std::size_t>(view_json.integer("byteStride", static_cast<std::int64_t>(element_bytes), 1, 252));
    if (stride < element_bytes)
      view_json.at("byteStride")
          .fail("is " + std::to_string(stride) + ", less than an element's " + std::to_string(element_bytes) + " bytes");
  }
  const auto offset = static_cast<std::size_t>(owner.integer("byteOffset", 0, 0, kMaxInteger));
  const std::size_t needed = count == 0 ? 0 : stride * (count - 1) + element_bytes;
  if (offset > bytes.size() || needed > bytes.size() - offset)
    owner.fail("count " + std::to_string(count) + " at offset " + std::to_string(offset) + " needs " + std::to_string(needed) +
                   " bytes, bufferView " + std::to_string(view) + " has " + std::to_string(bytes.size()),
               "the file is broken; export it again");
  return {bytes.data() + offset, stride};
}

AccessorLayout layout_of(const JsonCursor& accessor) {
  AccessorLayout layout;
  layout.count = static_cast<std::size_t>(accessor.at("count").as_integer(1, kMaxInteger));
  layout.components = components_of(accessor.at("type"));
  layout.component = component_type(accessor);
  layout.normalized = accessor.flag("normalized", false);
  layout.element_bytes = bytes_of(layout.component) * static_cast<std::size_t>(layout.components);
  return layout;
}

Elements dense_elements(const GltfDocument& document, const JsonCursor& accessor, const AccessorLayout& layout) {
  if (accessor.has("bufferView")) return checked_elements(document, accessor, layout.count, layout.element_bytes, true);
  if (layout.count > kMaxZeros)
    accessor.fail("count " + std::to_string(layout.count) + " without a bufferView, more than " + std::to_string(kMaxZeros) + " zeros");
  return {};
}

template <class T>
T load(const std::uint8_t* p) {
  T value;
  std::memcpy(&value, p, sizeof value);  // unaligned and little-endian, as this program's machines are
  return value;
}

double component_value(const std::uint8_t* p, const AccessorLayout& layout) {
  switch (layout.component) {
    case kByte: {
      const double x = load<std::int8_t>(p);
      return layout.normalized ? std::max(x / 127, -1.0) : x;
    }
    case kUnsignedByte: return layout.normalized ? *p / 255.0 : *p;
    case kShort: {
      const double x = load<std::int16_t>(p);
      return layout.normalized ? std::max(x / 32767, -1.0) : x;
    }
    case kUnsignedShort: {
      const double x = load<std::uint16_t>(p);
      return layout.normalized ? x / 65535 : x;
    }
    case kUnsignedInt: return load<std::uint32_t>(p);
    default: return load<float>(p);
  }
}

struct Sparse {
  std::vector<std::uint32_t> indices;
  Elements values;
};

std::uint32_t unsigned_value(const std::uint8_t* p, int component) {
  if (component == kUnsignedByte) return *p;
  if (component == kUnsignedShort) return load<std::uint16_t>(p);
  return load<std::uint32_t>(p);
}

Sparse read_sparse(const GltfDocument& document, const JsonCursor& accessor, const AccessorLayout& layout) {
  Sparse result;
  const auto sparse = accessor.find("sparse");
  if (!sparse) return result;
  const auto count = static_cast<std::size_t>(sparse->at("count").as_integer(1, kMaxInteger));
  if (count > layout.count)
    sparse->at("count").fail("is " + std::to_string(count) + ", more than the accessor's " + std::to_string(layout.count));
  const JsonCursor indices = sparse->at("indices");
  const int component = component_type(indices);
  if (component != kUnsignedByte && component != kUnsignedShort && component != kUnsignedInt)
    indices.at("componentType").fail("sparse indices must be unsigned integers");
  const Elements where = checked_elements(document, indices, count, bytes_of(component), false);
  result.values = checked_elements(document, sparse->at("values"), count, layout.element_bytes, false);
  result.indices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = unsigned_value(where.data + i * where.stride, component);
    if (index >= layout.count)
      indices.fail("element " + std::to_string(i) + " is " + std::to_string(index) + ", the accessor has " + std::to_string(layout.count));
    result.indices.push_back(index);
  }
  return result;
}

AccessorLayout allowed_layout(const JsonCursor& accessor, std::string_view types) {
  const AccessorLayout layout = layout_of(accessor);
  const std::string type = accessor.at("type").as_text();
  if (!words::contains(types, type)) accessor.at("type").fail("is " + type + ", must be " + std::string(types));
  return layout;
}

}  // namespace

std::size_t checked_count(const GltfDocument& document, int index) {
  const JsonCursor accessor = document.object("accessors", index);
  const AccessorLayout layout = layout_of(accessor);
  dense_elements(document, accessor, layout);
  return layout.count;
}

namespace {

FloatArray read_some_floats(const GltfDocument& document, int index, std::string_view types, NotFinite not_finite, std::size_t most) {
  const JsonCursor accessor = document.object("accessors", index);
  const AccessorLayout layout = allowed_layout(accessor, types);
  const Elements dense = dense_elements(document, accessor, layout);
  const Sparse sparse = read_sparse(document, accessor, layout);

  FloatArray result;
  result.count = std::min(layout.count, most);
  result.components = layout.components;
  const auto components = static_cast<std::size_t>(layout.components);
  result.values.resize(result.count * components);
  const auto store = [&](std::size_t element, const std::uint8_t* p) {
    for (std::size_t c = 0; c < components; ++c) {
      const double x = component_value(p + c * bytes_of(layout.component), layout);
      if (!std::isfinite(x) && not_finite == NotFinite::refuse)
        accessor.fail("element " + std::to_string(element) + " is not finite", "the file is broken; export it again");
      result.values[element * components + c] = std::isfinite(x) ? static_cast<float>(x) : 0.0f;
    }
  };
  if (dense.data)
    for (std::size_t i = 0; i < result.count; ++i) store(i, dense.data + i * dense.stride);
  for (std::size_t i = 0; i < sparse.indices.size(); ++i)
    if (sparse.indices[i] < result.count) store(sparse.indices[i], sparse.values.data + i * sparse.values.stride);
  return result;
}

}  // namespace

FloatArray read_floats(const GltfDocument& document, int accessor, std::string_view types, NotFinite not_finite) {
  return read_some_floats(document, accessor, types, not_finite, std::numeric_limits<std::size_t>::max());
}

FloatArray read_first_floats(const GltfDocument& document, int accessor, std::string_view types, std::size_t most) {
  return read_some_floats(document, accessor, types, NotFinite::refuse, most);
}

std::vector<std::uint32_t> read_unsigned(const GltfDocument& document, int index, std::string_view types) {
  const JsonCursor accessor = document.object("accessors", index);
  const AccessorLayout layout = allowed_layout(accessor, types);
  if (layout.component != kUnsignedByte && layout.component != kUnsignedShort && layout.component != kUnsignedInt)
    accessor.at("componentType").fail("must be an unsigned integer type");
  const Elements dense = dense_elements(document, accessor, layout);
  const Sparse sparse = read_sparse(document, accessor, layout);

  const auto components = static_cast<std::size_t>(layout.components);
  std::vector<std::uint32_t> result(layout.count * components);
  const auto store = [&](std::size_t element, const std::uint8_t* p) {
    for (std::size_t c = 0; c < components; ++c)
      result[element * components + c] = unsigned_value(p + c * bytes_of(layout.component), layout.component);
  };
  if (dense.data)
    for (std::size_t i = 0; i < layout.count; ++i) store(i, dense.data + i * dense.stride);
  for (std::size_t i = 0; i < sparse.indices.size(); ++i) store(sparse.indices[i], sparse.values.data + i * sparse.values.stride);
  return result;
}

}  // namespace steradian::scene
