#include "body_numbers.h"

#include "steradian/error.h"

namespace steradian::plane {
namespace {

class Writer {
 public:
  void put(double x) { numbers.push_back(x); }
  void put(Vec2d v) { put(v.x), put(v.y); }
  void put(const Vec3d& v) { put(v.x), put(v.y), put(v.z); }

  std::vector<double> numbers;
};

class Reader {
 public:
  Reader(const double* at, std::size_t count) : at_(at), end_(at + count) {}

  double number() {
    if (at_ == end_) throw Error("body", "its list of numbers ends early", "see src/bodies.js");
    return *at_++;
  }
  Vec2d pair() {
    const double x = number();
    return {x, number()};
  }
  Vec3d triple() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  // How many things of so many numbers follow.
  std::size_t count(std::size_t numbers_each) {
    const double n = number();
    if (!(n >= 0 && n * static_cast<double>(numbers_each) <= static_cast<double>(end_ - at_)))
      throw Error("body", "counts more than its list of numbers holds", "see src/bodies.js");
    return static_cast<std::size_t>(n);
  }
  int choice(int choices) {
    const double n = number();
    if (!(n >= 0 && n < choices)) throw Error("body", "its shape or profile is none that there is", "see src/bodies.js");
    return static_cast<int>(n);
  }
  void finish() const {
    if (at_ != end_) throw Error("body", "its list of numbers goes on after its end", "see src/bodies.js");
  }

 private:
  const double *at_, *end_;
};

void put_emission(Writer& out, const PlaneEmission& e) {
  out.put(e.radiance);
  out.put(static_cast<double>(e.profile));
  out.put(e.range);
  out.put(e.spot_axis);
  out.put(e.spot_half_angle);
  out.put(e.gradient ? static_cast<double>(e.gradient->stops.size()) : 0.0);
  if (!e.gradient) return;
  out.put(e.gradient->from);
  out.put(e.gradient->to);
  for (const PlaneStop& s : e.gradient->stops) out.put(s.offset), out.put(s.radiance);
}

PlaneEmission emission_from(Reader& in) {
  PlaneEmission e;
  e.radiance = in.triple();
  e.profile = static_cast<PlaneProfile>(in.choice(3));
  e.range = in.number();
  e.spot_axis = in.pair();
  e.spot_half_angle = in.number();
  if (const std::size_t stops = in.count(4)) {
    PlaneGradient g;
    g.from = in.pair();
    g.to = in.pair();
    for (std::size_t i = 0; i < stops; ++i) {
      const double offset = in.number();
      g.stops.push_back({offset, in.triple()});
    }
    e.gradient = std::move(g);
  }
  return e;
}

}  // namespace

std::vector<double> numbers_of(const PlaneBody& body) {
  Writer out;
  out.put(static_cast<double>(body.shape));
  out.put(body.even_odd ? 1.0 : 0.0);
  out.put(body.center);
  out.put(body.x_axis);
  out.put(body.y_axis);
  out.put(body.radius);
  out.put(body.color);
  out.put(body.albedo ? 1.0 : 0.0);
  out.put(body.albedo.value_or(Vec3d()));
  out.put(body.light ? 1.0 : 0.0);
  if (body.light) put_emission(out, *body.light);
  out.put(static_cast<double>(body.contours.size()));
  for (const auto& contour : body.contours) {
    out.put(static_cast<double>(contour.size()));
    for (Vec2d p : contour) out.put(p);
  }
  return std::move(out.numbers);
}

PlaneBody body_of(const double* numbers, std::size_t count) {
  Reader in(numbers, count);
  PlaneBody body;
  body.shape = static_cast<PlaneBody::Shape>(in.choice(4));
  body.even_odd = in.number() != 0;
  body.center = in.pair();
  body.x_axis = in.pair();
  body.y_axis = in.pair();
  body.radius = in.number();
  body.color = in.triple();
  const bool has_albedo = in.number() != 0;
  const Vec3d albedo = in.triple();
  if (has_albedo) body.albedo = albedo;
  if (in.number() != 0) body.light = emission_from(in);
  body.contours.resize(in.count(1));
  for (auto& contour : body.contours) {
    contour.resize(in.count(2));
    for (Vec2d& p : contour) p = in.pair();
  }
  in.finish();
  return body;
}

}  // namespace steradian::plane
