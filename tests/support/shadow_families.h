// Families of geometry that test the shadows: each is a light, its occluders, and viewpoints.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/random.h"
#include "shadow/edges/edges.h"
#include "shadow/edges/segments.h"
#include "steradian/polygon_light.h"
#include "support/random_configurations.h"

namespace steradian::shadow::families {

using reference::Random;

struct Triangles {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;

  std::uint32_t vertex(Vec3d p) {
    positions.push_back(p);
    return static_cast<std::uint32_t>(positions.size() - 1);
  }
  void triangle(Vec3d a, Vec3d b, Vec3d c) {
    for (const Vec3d p : {a, b, c}) indices.push_back(vertex(p));
  }
  void quad(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  // A closed box by its centre and three half axes.
  void box(Vec3d c, Vec3d x, Vec3d y, Vec3d z) {
    const auto face = [&](Vec3d n, Vec3d s, Vec3d t) { quad(c + n - s - t, c + n + s - t, c + n + s + t, c + n - s + t); };
    face(x, y, z);
    face(-x, z, y);
    face(y, z, x);
    face(-y, x, z);
    face(z, x, y);
    face(-z, y, x);
  }
  void box(Vec3d low, Vec3d high) {
    const Vec3d h = (high - low) * 0.5;
    box((low + high) * 0.5, {h.x, 0, 0}, {0, h.y, 0}, {0, 0, h.z});
  }
  // A surface over a grid of parameters, closed in both where they wrap.
  template <class At>
  void grid(int columns, int rows, At at) {
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) {
        const Vec3d a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        triangle(a, b, c);
        triangle(a, c, d);
      }
  }
  void sphere(Vec3d center, double radius, int columns, int rows) {
    grid(columns, rows, [&](int i, int j) {
      const double u = 2 * std::numbers::pi * (i % columns) / columns;
      if (j == 0 || j == rows) return center + Vec3d{0, j == 0 ? radius : -radius, 0};
      const double v = std::numbers::pi * j / rows;
      return center + Vec3d{std::sin(v) * std::cos(u), std::cos(v), -std::sin(v) * std::sin(u)} * radius;
    });
  }
  void torus(Vec3d center, Vec3d x, Vec3d y, double ring, double tube, int columns, int rows) {
    const Vec3d z = cross(x, y);
    grid(columns, rows, [&](int i, int j) {
      const double u = 2 * std::numbers::pi * (i % columns) / columns, v = 2 * std::numbers::pi * (j % rows) / rows;
      return center + (x * std::cos(u) + y * std::sin(u)) * (ring + tube * std::cos(v)) + z * (tube * std::sin(v));
    });
  }
};

struct Family {
  std::string name;
  Triangles triangles;
  PolygonLight light;
  Vec3d low{-1, 0, -1}, high{1, 1.8, 1};  // bounds of the points in the air and on the floor (y = 0)
  double edges_tolerance = 2e-5;          // rms of the error by cells, relative to the unoccluded value
  bool contact = false;                   // points close to objects that stand on the floor
  bool near_surface = false;              // points 0.02 off the occluders
};

// A point with its normals; the position is already moved off the surface.
struct Point {
  Viewpoint at;
  std::string kind;
};

inline PolygonLight rectangle(Vec3d c, Vec3d x, Vec3d y) {
  PolygonLight light;
  light.vertices = {c - x - y, c + x - y, c + x + y, c - x + y};
  return light;
}

// A light that faces down, above the middle.
inline PolygonLight ceiling_light(double height = 2.5, double half = 0.5) {
  return rectangle({0, height, 0}, {half, 0, 0}, {0, 0, half * 0.8});
}

inline PolygonLight tilted_light() {
  return rectangle({0.3, 2.4, -0.2}, Vec3d{0.48, 0.1, 0.05}, Vec3d{-0.03, 0.12, 0.4} - Vec3d{0.48, 0.1, 0.05} * (0.0176 / 0.2429));
}

inline PolygonLight star_light() {
  PolygonLight light;
  for (int i = 0; i < 10; ++i) {
    const double t = std::numbers::pi * i / 5, r = i % 2 == 0 ? 0.6 : 0.25;
    light.vertices.push_back({r * std::cos(t), 2.4, r * std::sin(t)});
  }
  return light;
}

inline Triangles random_boxes(int count, std::uint64_t seed) {
  Triangles t;
  Random r(seed);
  for (int i = 0; i < count; ++i) {
    const Vec3d c{r.uniform(-0.7, 0.7), r.uniform(0.3, 1.6), r.uniform(-0.7, 0.7)};
    const Frame f = Frame::from_normal(random_direction(r));
    t.box(c, f.x * r.uniform(0.08, 0.3), f.y * r.uniform(0.08, 0.3), f.z * r.uniform(0.08, 0.3));
  }
  return t;
}

inline std::vector<Family> all() {
  std::vector<Family> result;
  const auto add = [&](std::string name, Triangles t, PolygonLight light) -> Family& {
    result.push_back({std::move(name), std::move(t), std::move(light)});
    return result.back();
  };
  Triangles one_box;
  one_box.box({-0.3, 0.6, -0.25}, {0.3, 1.0, 0.3});
  add("box", one_box, ceiling_light());
  PolygonLight ring = star_light();
  ring.vertices.clear();
  ring.holes.emplace_back();
  for (int i = 0; i < 12; ++i) {
    const double u = std::numbers::pi * i / 6;
    ring.vertices.push_back({0.6 * std::cos(u), 2.5, 0.6 * std::sin(u)});
    ring.holes[0].push_back({0.35 * std::cos(u), 2.5, 0.35 * std::sin(u)});
  }
  add("box under a ring", one_box, ring);
  add("12 boxes", random_boxes(12, 3), ceiling_light());
  add("12 boxes from the side", random_boxes(12, 4), rectangle({2.4, 0.9, 0}, {0, 0, 0.4}, {0, 0.5, 0}));
  add("12 boxes under a star", random_boxes(12, 5), star_light());
  Triangles ball;
  ball.sphere({0.1, 0.9, 0}, 0.45, 32, 21);  // 1280 triangles but for the poles'
  add("sphere", ball, ceiling_light());
  Triangles fine;
  fine.sphere({0.1, 0.9, 0}, 0.45, 256, 161);
  add("fine sphere from close by", fine, ceiling_light()).near_surface = true;
  Triangles tori;
  tori.torus({-0.2, 1, 0}, {1, 0, 0}, {0, 0, 1}, 0.4, 0.1, 24, 12);
  tori.torus({0.2, 1, 0}, {1, 0, 0}, {0, 1, 0}, 0.4, 0.1, 24, 12);
  add("linked tori", tori, ceiling_light());
  {
    Triangles t;
    Random r(7);
    for (int i = 0; i < 14; ++i) {
      const Vec3d c{r.uniform(-0.7, 0.7), r.uniform(0.3, 1.6), r.uniform(-0.7, 0.7)};
      const Frame f = Frame::from_normal(random_direction(r));
      const Vec3d x = f.x * r.uniform(0.1, 0.35), y = f.y * r.uniform(0.1, 0.35);
      t.quad(c - x - y, c + x - y, c + x + y, c - x + y);
    }
    add("open quads", t, ceiling_light());
  }
  {
    Triangles t;
    Random r(8);
    for (int i = 0; i < 6; ++i) {
      const Frame f = Frame::from_normal(random_direction(r));
      t.box({r.uniform(-0.6, 0.6), 2.4 + r.uniform(-0.1, 0.2), r.uniform(-0.5, 0.5)}, f.x * 0.2, f.y * 0.15, f.z * 0.12);
    }
    add("boxes through the light's plane", t, ceiling_light(2.4));
  }
  for (const bool tilted : {true, false}) {
    const std::string under = tilted ? ", tilted light" : ", parallel light";
    const PolygonLight light = tilted ? tilted_light() : ceiling_light();
    Triangles abutting;
    for (int i = -2; i < 2; ++i)
      for (int j = 0; j < 3; ++j) abutting.box({0.25 * i, 0.5 + 0.25 * j, -0.25}, {0.25 * (i + 1), 0.5 + 0.25 * (j + 1), 0.25});
    add("abutting boxes" + under, abutting, light);
    Triangles junctions;
    for (int i = 0; i < 4; ++i)
      junctions.quad({-0.5 + 0.25 * i, 1, -0.5}, {-0.5 + 0.25 * i, 1, 0}, {-0.25 + 0.25 * i, 1, 0}, {-0.25 + 0.25 * i, 1, -0.5});
    junctions.quad({-0.5, 1, 0}, {-0.5, 1, 0.5}, {0.5, 1, 0.5}, {0.5, 1, 0});
    junctions.quad({-0.5, 1, 0}, {0.5, 1, 0}, {0.5, 0.5, 0.25}, {-0.5, 0.5, 0.25});
    add("T-junctions" + under, junctions, light);
    Triangles shelves;
    for (int i = 0; i < 4; ++i) shelves.box({-0.6, 0.25 + 0.375 * i, -0.2}, {0.6, 0.3125 + 0.375 * i, 0.2});
    shelves.box({-0.6, 0, -0.2}, {-0.55, 1.5, 0.2});
    shelves.box({0.55, 0, -0.2}, {0.6, 1.5, 0.2});
    add("shelves" + under, shelves, light);
    Triangles coincident;
    coincident.box({-0.5, 0.5, -0.25}, {0, 1, 0.25});
    coincident.box({0, 0.5, -0.25}, {0.5, 1, 0.25});
    coincident.box({-0.5, 0.5, -0.25}, {0, 1, 0.25});
    coincident.box({-0.25, 0.75, -0.25}, {0.25, 1, 0.25});
    coincident.quad({-0.5, 1, -0.25}, {0.5, 1, -0.25}, {0.5, 1, 0.25}, {-0.5, 1, 0.25});
    add("coincident faces" + under, coincident, light);
  }
  {
    Triangles t;
    for (int i = -2; i <= 2; ++i)
      for (int j = -1; j <= 1; ++j) t.box({0.3 * i - 0.05, 0, 0.4 * j - 0.05}, {0.3 * i + 0.05, 1.25, 0.4 * j + 0.05});
    t.box({-0.75, 1.25, -0.5}, {0.75, 1.375, 0.5});
    t.box({-1, -0.125, -1}, {1, 0, 1});
    add("columns and slabs", t, rectangle({1.2, 2.4, 0.4}, {0.3, 0, 0}, {0, 0, 0.3}));
  }
  for (const int bars : {8, 24}) {
    Triangles t;
    for (int i = 0; i < bars; ++i) {
      const double x = -0.6 + 1.2 * (i + 0.5) / bars, w = 0.3 / bars;
      t.box({x - w, 1.2, -0.6}, {x + w, 1.2 + 2 * w, 0.6});
      if (bars == 8) t.box({-0.6, 1.2 + 2 * w, x - w}, {0.6, 1.2 + 4 * w, x + w});
    }
    add("grille of " + std::to_string(bars), t, bars == 8 ? ceiling_light() : tilted_light());
  }
  {
    Triangles t;
    for (int i = 0; i < 5; ++i) {
      const double u = 2 * std::numbers::pi * i / 5;
      t.quad({-0.5, 1, 0}, {0.5, 1, 0}, {0.5, 1 + 0.4 * std::sin(u), 0.4 * std::cos(u)}, {-0.5, 1 + 0.4 * std::sin(u), 0.4 * std::cos(u)});
    }
    add("fins on one edge", t, ceiling_light());
  }
  {
    Triangles t;
    t.quad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2});
    t.box({-0.5, 0, -0.5}, {0, 0.5, 0});
    t.box({0.1, 0, -0.3}, {0.4, 1, 0});
    t.sphere({0.2, 0.3, 0.5}, 0.3, 32, 16);
    add("contact", t, ceiling_light(2.2, 0.6)).contact = true;
  }
  {
    Triangles t;  // a cone open below, a lid above
    const int n = 24;
    const auto rim = [&](int i, double radius, double height) {
      const double u = 2 * std::numbers::pi * (i % n) / n;
      return Vec3d{radius * std::cos(u), height, radius * std::sin(u)};
    };
    for (int i = 0; i < n; ++i) {
      t.quad(rim(i, 0.5, 1.2), rim(i, 0.3, 1.8), rim(i + 1, 0.3, 1.8), rim(i + 1, 0.5, 1.2));
      t.triangle(rim(i, 0.3, 1.8), {0, 1.8, 0}, rim(i + 1, 0.3, 1.8));
    }
    PolygonLight bulb = rectangle({0, 1.5, 0}, {0.1, 0, 0}, {0, 0, 0.1});
    bulb.two_sided = true;
    Family& family = add("lamp shade", t, bulb);
    family.low = {-0.6, 0.2, -0.6};
    family.high = {0.6, 2.2, 0.6};
  }
  {
    Triangles t;
    t.quad({-2, 2.5, -2}, {2, 2.5, -2}, {2, 2.5, 2}, {-2, 2.5, 2});
    t.box({-0.5, 2.0, -0.2}, {-0.2, 2.5, 0.1});
    t.box({0.1, 1.8, 0}, {0.3, 2.5, 0.1});
    t.sphere({0.1, 2.2, -0.3}, 0.3, 24, 12);
    add("occluders and ceiling that touch the light", t, ceiling_light());
  }
  {
    Triangles t;  // viewed from inside; the light is outside the window in the wall x = 1.5
    t.box({-1.6, -0.1, -1.5}, {1.5, 0, 1.5});
    t.box({-1.6, 2, -1.5}, {1.5, 2.1, 1.5});
    t.box({-1.6, 0, -1.5}, {-1.5, 2, 1.5});
    t.box({-1.6, 0, -1.6}, {1.6, 2, -1.5});
    t.box({-1.6, 0, 1.5}, {1.6, 2, 1.6});
    t.box({1.5, 0, -1.5}, {1.6, 0.8, 1.5});
    t.box({1.5, 1.6, -1.5}, {1.6, 2, 1.5});
    t.box({1.5, 0.8, -1.5}, {1.6, 1.6, -0.5});
    t.box({1.5, 0.8, 0.5}, {1.6, 1.6, 1.5});
    t.box({1.53, 0.8, -0.02}, {1.57, 1.6, 0.02});
    t.box({-0.6, 0, -0.4}, {0.4, 0.6, 0.4});
    add("room with a window", t, rectangle({2.2, 1.6, 0.2}, {0, 0, 0.8}, {0.3, 0.6, 0}));
  }
  {
    Triangles t;
    Random r(11);
    for (int i = 0; i < 300; ++i) {
      const Vec3d c{r.uniform(-0.8, 0.8), r.uniform(0.2, 1.8), r.uniform(-0.8, 0.8)};
      t.triangle(c + random_direction(r) * 0.12, c + random_direction(r) * 0.12, c + random_direction(r) * 0.12);
    }
    add("soup", t, ceiling_light()).edges_tolerance = 5e-5;
  }
  {
    Triangles t;
    Random r(12);
    for (int i = 0; i < 200; ++i) {
      const Vec3d c{r.uniform(-0.7, 0.7), r.uniform(0.6, 1.7), r.uniform(-0.7, 0.7)};
      const Frame f = Frame::from_normal(random_direction(r));
      t.quad(c - f.x * 0.1, c - f.y * 0.03, c + f.x * 0.1, c + f.y * 0.03);
    }
    add("leaves", t, tilted_light()).edges_tolerance = 5e-5;
  }
  return result;
}

// A point that the light reaches except for occluders: on the floor, in the air or on an occluder. Every third has a shading normal of its
// own. Every fourth lies on a lattice that puts faces edge-on and edges on edges.
// rounding: of the numbers that hold the point (offset_from_surface).
inline Point random_point(const Family& family, const EdgeMesh& mesh, const PreparedPolygon& light, Random& r, double rounding = 0x1p-24) {
  double reach = 0;
  for (const Vec3d& v : mesh.vertices) reach = std::max(reach, largest_coordinate(v));
  for (;;) {
    Point point;
    const double which = r.uniform();
    const bool lattice = r.uniform() < 0.25, bent = r.uniform() < 1.0 / 3;
    const auto on_lattice = [&](double x) { return lattice ? std::round(x * 8) / 8 : x; };
    Vec3d position, normal;
    const Vec3d anywhere{on_lattice(r.uniform(family.low.x, family.high.x)), on_lattice(r.uniform(family.low.y, family.high.y)),
                         on_lattice(r.uniform(family.low.z, family.high.z))};
    if (family.contact && which < 0.6) {
      const double off = 2e-4 * std::pow(100, r.uniform());
      const double side = r.uniform(), along = r.uniform(-0.5, 0);
      const double t = r.uniform(0, 2 * std::numbers::pi);
      position = side < 0.3   ? Vec3d{off, 0, along}
                 : side < 0.6 ? Vec3d{0.1 + (along + 0.5) * 0.6, 0, off}
                              : Vec3d{0.2 + off * std::cos(t), 0, 0.5 + off * std::sin(t)};
      normal = {0, 1, 0};
      point.kind = "contact";
    } else if (which < 0.4) {
      position = {anywhere.x, 0, anywhere.z};
      normal = {0, 1, 0};
      point.kind = "floor";
    } else if (which < 0.65 && !family.near_surface) {
      position = anywhere;
      normal = lattice ? Vec3d{0, 1, 0} : random_direction(r);
      if (!light.two_sided && dot(normal, light.centroid - position) < 0) normal = -normal;
      point.kind = "air";
    } else {
      const auto t = static_cast<std::size_t>(r.uniform() * static_cast<double>(mesh.triangles.size()));
      double u = r.uniform(), v = r.uniform();
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Vec3d a = mesh.vertices[mesh.triangles[t][0]], b = mesh.vertices[mesh.triangles[t][1]], c = mesh.vertices[mesh.triangles[t][2]];
      position = a + (b - a) * u + (c - a) * v;
      normal = normalized(mesh.planes[t].normal) * (r.uniform() < 0.5 ? -1.0 : 1.0);
      if (family.near_surface) position += normal * 0.02;
      point.kind = "occluder";
    }
    if (!(dot(normal, normal) > 0.5)) continue;
    point.at.position = position + normal * offset_from_surface(position, reach, rounding);
    point.at.normal = normal;
    if (bent) {
      point.at.normal = normalized(normal + random_direction(r) * 0.6);
      point.at.geometric_normal = normal;
    }
    const int side = light.side_of(point.at.position);
    if (side == 0 || (side < 0 && !light.two_sided)) continue;
    // Skip the light's plane itself, where nothing is well posed.
    const double height = std::fabs(dot(point.at.position - light.centroid, light.normal));
    if (height < 1e-3) continue;
    return point;
  }
}

}  // namespace steradian::shadow::families
