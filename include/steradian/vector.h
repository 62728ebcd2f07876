// Vec3d, Vec3f: plain vectors for scenes and hosts. Kernels have their own (vec.h), made of Real<S>.
#pragma once

#include <cmath>

namespace steradian {

template <class T>
struct Vector3 {
  T x{}, y{}, z{};

  friend constexpr Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vector3 operator*(Vector3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vector3 operator*(T s, Vector3 a) { return a * s; }
  friend constexpr Vector3 operator*(Vector3 a, Vector3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vector3 operator/(Vector3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  constexpr Vector3& operator+=(Vector3 b) { return *this = *this + b; }
  constexpr Vector3& operator-=(Vector3 b) { return *this = *this - b; }
  constexpr Vector3& operator*=(T s) { return *this = *this * s; }
  friend constexpr bool operator==(Vector3 a, Vector3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

  template <class U>
  constexpr explicit operator Vector3<U>() const {
    return {static_cast<U>(x), static_cast<U>(y), static_cast<U>(z)};
  }
};

using Vec3d = Vector3<double>;
using Vec3f = Vector3<float>;

template <class T>
constexpr T dot(Vector3<T> a, Vector3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vector3<T> cross(Vector3<T> a, Vector3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(Vector3<T> a) {
  return std::sqrt(dot(a, a));
}
// Unit vector; the zero vector stays zero.
template <class T>
Vector3<T> normalized(Vector3<T> a) {
  const T square = dot(a, a);
  if (square > T(1e-30) && square < T(1e30)) return a / std::sqrt(square);
  // The squares of tiny and huge vectors would leave the range.
  const T largest = std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z)));
  if (!(largest > T(0))) return {};
  a = a / largest;
  return a / length(a);
}
template <class T>
bool is_finite(Vector3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// Rodrigues' rotation of a vector about a unit axis.
inline Vec3d rotated(Vec3d v, Vec3d axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c));
}

// Columns of an orthonormal right-handed frame with z along the unit vector n.
// Source: Duff et al., "Building an orthonormal basis, revisited", 2017.
struct Frame {
  Vec3d x, y, z;

  static Frame world() { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }
  static Frame from_normal(Vec3d n) {
    const double s = std::copysign(1.0, n.z);
    const double a = -1.0 / (s + n.z);
    const double b = n.x * n.y * a;
    return {{1.0 + s * n.x * n.x * a, s * b, -s * n.x}, {b, s + n.y * n.y * a, -n.y}, n};
  }
  // Frame with x along the part of t that is perpendicular to n; any frame about n if t has none.
  static Frame from_normal_and_tangent(Vec3d n, Vec3d t) {
    Vec3d x = normalized(t - n * dot(n, t));
    if (const double along = dot(x, n); !(std::fabs(along) < 1e-9)) {  // t is along n, to the rounding of the rest
      x = x - n * along;
      if (length(x) < 0.5) return from_normal(n);
      x = normalized(x);
    }
    if (length(x) < 0.5) return from_normal(n);
    return {x, cross(n, x), n};
  }
  Vec3d to_local(Vec3d w) const { return {dot(x, w), dot(y, w), dot(z, w)}; }
  Vec3d to_world(Vec3d l) const { return x * l.x + y * l.y + z * l.z; }
};

// True if a channel of a weight is positive.
constexpr bool weighs(Vec3f v) { return v.x > 0 || v.y > 0 || v.z > 0; }

}  // namespace steradian
