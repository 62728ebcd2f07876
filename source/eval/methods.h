// The methods of `steradian eval` by name, and what each can do. The table is in methods.cpp: one entry a method.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "steradian/closed_form.h"  // Quality
#include "steradian/material.h"
#include "steradian/polygon_light.h"
#include "steradian/reference.h"

namespace steradian::eval {

enum class Precision { double_, float_ };

// `automatic` stands for the first method of the table that serves the lobe; a draft takes the table for GGX where it can.
enum class Method {
  automatic, exact, arvo, lorentzian, pearson, ellipsoid, series, closed_form, ltc, ltc_compact, ltc_clipless,
  representative_point, half_vector, reference, sampled
};

// What the methods need to know of a query.
struct MethodOptions {
  Precision precision = Precision::double_;
  Quality quality = Quality::normal;
  int spp = 256;
  std::uint64_t seed = 1;
};

// Light that one lobe sends to the view.
struct LobeAnswer {
  Vec3d radiance;
  std::optional<double> bound;           // of methods that bound their error
  std::optional<double> standard_error;  // of methods that estimate it
};

struct MethodEntry {
  Method method;
  const char* name;
  bool (*serves)(const Material& material);
  bool in_float;  // has "precision": "float"
  LobeAnswer (*polygon)(const PreparedPolygon&, const ShadingPoint&, const Material&, const MethodOptions&);
};

// In the order of preference of `auto`.
std::span<const MethodEntry> methods();

std::optional<Method> method_of(std::string_view name);
std::string method_names();  // "auto, series, exact, ..."

// The method that a query's method comes down to for one lobe.
// Throws Error where it does not serve the lobe or the precision.
const MethodEntry& resolve(Method method, const Material& material, Precision precision, Quality quality);

}  // namespace steradian::eval
