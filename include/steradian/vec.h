// Vec2, Vec3, Vec4, Mat3: the vectors of the kernel dialect in C++. R is a Real<S>.
//
// The member functions and free functions are those of the dialect (docs/dialect.md) and no more, so that what
// compiles here compiles in GLSL. The order of operations is written out: a dot product sums from x to z in every
// language, so that results agree to the last bit where contraction is off.
#pragma once

#include "steradian/real.h"

STERADIAN_BEGIN_ISA

template <class R>
struct Vec2 {
  R x, y;
  Vec2() = default;
  STERADIAN_INLINE Vec2(R x_, R y_) : x(x_), y(y_) {}
  STERADIAN_INLINE friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  STERADIAN_INLINE friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  STERADIAN_INLINE friend Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  STERADIAN_INLINE friend Vec2 operator*(Vec2 a, R s) { return {a.x * s, a.y * s}; }
  STERADIAN_INLINE friend Vec2 operator*(R s, Vec2 a) { return {s * a.x, s * a.y}; }
  STERADIAN_INLINE friend R dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
  STERADIAN_INLINE friend Vec2 select(typename R::M m, Vec2 a, Vec2 b) { return {select(m, a.x, b.x), select(m, a.y, b.y)}; }
};

template <class R>
struct Vec3 {
  R x, y, z;
  Vec3() = default;
  STERADIAN_INLINE Vec3(R x_, R y_, R z_) : x(x_), y(y_), z(z_) {}
  STERADIAN_INLINE friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  STERADIAN_INLINE friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  STERADIAN_INLINE friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  STERADIAN_INLINE friend Vec3 operator*(Vec3 a, R s) { return {a.x * s, a.y * s, a.z * s}; }
  STERADIAN_INLINE friend Vec3 operator*(R s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  STERADIAN_INLINE friend R dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  STERADIAN_INLINE friend Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
  STERADIAN_INLINE friend Vec3 select(typename R::M m, Vec3 a, Vec3 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
  }
};

template <class R>
struct Vec4 {
  R x, y, z, w;
  Vec4() = default;
  STERADIAN_INLINE Vec4(R x_, R y_, R z_, R w_) : x(x_), y(y_), z(z_), w(w_) {}
  STERADIAN_INLINE friend Vec4 operator+(Vec4 a, Vec4 b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
  STERADIAN_INLINE friend Vec4 operator-(Vec4 a, Vec4 b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
  STERADIAN_INLINE friend Vec4 operator*(Vec4 a, R s) { return {a.x * s, a.y * s, a.z * s, a.w * s}; }
  STERADIAN_INLINE friend Vec4 operator*(R s, Vec4 a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
  STERADIAN_INLINE friend Vec4 select(typename R::M m, Vec4 a, Vec4 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
  }
};

// A matrix of three columns, built by mat3(c0, c1, c2). transform(m, v) = c0 v.x + c1 v.y + c2 v.z.
template <class R>
struct Mat3 {
  Vec3<R> c0, c1, c2;
  Mat3() = default;
  STERADIAN_INLINE Mat3(Vec3<R> a, Vec3<R> b, Vec3<R> c) : c0(a), c1(b), c2(c) {}
};

template <class R>
STERADIAN_INLINE Vec3<R> transform(Mat3<R> m, Vec3<R> v) {
  return m.c0 * v.x + m.c1 * v.y + m.c2 * v.z;
}

// The product with the transpose: the dot products of the columns with v. For a frame (three orthonormal columns) it transforms a world
// vector into the frame.
template <class R>
STERADIAN_INLINE Vec3<R> transform_transposed(Mat3<R> m, Vec3<R> v) {
  return {dot(m.c0, v), dot(m.c1, v), dot(m.c2, v)};
}

template <class R>
STERADIAN_INLINE Vec2<R> xy(Vec3<R> v) {
  return {v.x, v.y};
}

STERADIAN_END_ISA
