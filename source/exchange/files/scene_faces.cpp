#include "exchange/files/scene_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/box.h"
#include "exchange/pairs/plane_element.h"
#include "scene/emitters/merge_polygons.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

// More elements than this ask for a matrix that no machine holds.
constexpr double kMostElements = 4e6;

ViewFactorFace face_of_element(const PlaneElement& e, std::string name) {
  ViewFactorFace face{std::move(name), e.contours[0]};
  face.holes.assign(e.contours.begin() + 1, e.contours.end());
  return face;
}

std::string name_or(const std::string& name, const char* kind, std::size_t number) {
  return name.empty() ? std::string(kind) + std::to_string(number) : name;
}

ViewFactorFace back_of(const ViewFactorFace& face) {
  ViewFactorFace back = face;
  back.name += " back";
  std::reverse(back.outline.begin(), back.outline.end());
  for (auto& hole : back.holes) std::reverse(hole.begin(), hole.end());
  return back;
}

// The corners of a triangle from the least on, in their order around it.
using TriangleKey = std::array<std::array<double, 3>, 3>;
TriangleKey key_of(const scene::Triangle& t) {
  TriangleKey key;
  for (std::size_t c = 0; c < 3; ++c) key[c] = {t[c].x, t[c].y, t[c].z};
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

int steps_of(double length, double size) { return std::max(1, static_cast<int>(std::ceil(length / size * (1 - 1e-9)))); }

}  // namespace

std::vector<ViewFactorFace> divided_face(const ViewFactorFace& face, double size, Budget& budget) {
  const PlaneElement e = make_element(face.outline, face.holes, face.name);
  const double across = 2 * e.radius / size;
  if (!(across * across < kMostElements)) throw Error(face.name, "more than four million elements", "raise --divide");
  std::vector<ViewFactorFace> result;
  const auto name = [&] { return face.name + "." + std::to_string(result.size()); };
  const auto take = [&](double count) { budget.take_memory(face.name, "the elements of a face", static_cast<std::uint64_t>(count * 400)); };
  if (e.is_parallelogram()) {
    const int k = steps_of(2 * length(e.half_a), size), l = steps_of(2 * length(e.half_b), size);
    take(static_cast<double>(k) * l);
    const std::vector<Vec3d>& v = e.contours[0];
    // Corners of the outline are kept bit for bit, and neighbours share theirs.
    const auto at = [&](int i, int j) {
      const double s = static_cast<double>(i) / k, t = static_cast<double>(j) / l;
      if ((i == 0 || i == k) && (j == 0 || j == l)) return v[i == 0 ? (j == 0 ? 0 : 3) : (j == 0 ? 1 : 2)];
      return (v[0] * (1 - s) + v[1] * s) * (1 - t) + (v[3] * (1 - s) + v[2] * s) * t;
    };
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < l; ++j) result.push_back({name(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
    return result;
  }
  // Along the longest edge.
  Vec3d along{};
  const std::vector<Vec3d>& loop = e.contours[0];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3d edge = loop[(i + 1) % loop.size()] - loop[i];
    if (length(edge) > length(along)) along = edge;
  }
  const Frame axes = Frame::from_normal_and_tangent(e.normal, along);
  Box3d box;
  for (const Vec3d& v : loop) box.add(axes.to_local(v - e.centroid));
  const int k = steps_of(box.size().x, size), l = steps_of(box.size().y, size);
  take(static_cast<double>(k) * l);
  const auto cut = [&](PlaneElement part, Vec3d axis, double low, double high) {
    part = cut_element(part, e.centroid + axis * low, axis, 1);
    return part.is_empty() ? part : cut_element(part, e.centroid + axis * high, axis, -1);
  };
  const double far = 4 * e.radius;
  std::optional<std::vector<PlaneElement>> triangles;  // of the whole face
  for (int i = 0; i < k; ++i) {
    const auto step = [&](double low, double width, int at, int count) {
      return at == 0 ? -far : at == count ? far : low + width * at / count;
    };
    const auto strip_of = [&](const PlaneElement& whole) {
      return k == 1 ? whole : cut(whole, axes.x, step(box.low.x, box.size().x, i, k), step(box.low.x, box.size().x, i + 1, k));
    };
    const PlaneElement strip = strip_of(e);
    if (strip.is_empty()) continue;
    for (int j = 0; j < l; ++j) {
      const auto cell_of = [&](const PlaneElement& of) {
        return l == 1 ? of : cut(of, axes.y, step(box.low.y, box.size().y, j, l), step(box.low.y, box.size().y, j + 1, l));
      };
      // Slivers of rounding are no elements.
      const auto add = [&](const PlaneElement& part) {
        if (!part.is_empty() && part.area > 1e-12 * size * size) result.push_back(face_of_element(part, name()));
      };
      const PlaneElement part = cell_of(strip);
      if (part.is_empty() || is_simple(part)) {
        add(part);
        continue;
      }
      // The cut runs along a hole or through a notch: the triangles of the face have simple parts.
      if (!triangles) triangles = split_element(e).value_or(std::vector<PlaneElement>{});
      if (triangles->empty()) add(part);
      for (const PlaneElement& triangle : *triangles) {
        const PlaneElement of_triangle = strip_of(triangle);
        if (!of_triangle.is_empty()) add(cell_of(of_triangle));
      }
    }
  }
  return result;
}

namespace {

// Faces of one mesh: polygons as they are, and triangles joined with their coplanar neighbours.
class MeshFaces {
 public:
  explicit MeshFaces(Budget& budget) : budget_(budget) {}

  std::vector<ViewFactorFace> take(const PolygonMesh& mesh, const std::string& name) {
    std::vector<ViewFactorFace> faces;
    // Meshes of one name count on.
    std::size_t& number = numbered_[name];
    const auto next_name = [&] { return name + "#" + std::to_string(number++); };
    std::vector<scene::Triangle> triangles;
    std::vector<std::size_t> polygon_of;  // by triangle
    const auto count = [&](Drops& drops, std::size_t polygon) {
      if (drops.count++ == 0) drops.first = "face " + std::to_string(polygon + 1) + " of " + name;
    };
    const auto add_triangle = [&](Vec3d a, Vec3d b, Vec3d c, std::size_t polygon) {
      // Two faces in one place would both receive everything.
      if (known_.insert(key_of({a, b, c})).second) {
        triangles.push_back({a, b, c});
        polygon_of.push_back(polygon);
      } else {
        count(repeated_, polygon);
      }
    };
    for (std::size_t p = 0; p < mesh.polygons.size(); ++p) {
      const std::vector<Vec3d>& polygon = mesh.polygons[p];
      if (polygon.size() > 3 && known_.insert(key_of({polygon[0], polygon[1], polygon[2]})).second) {
        try {
          make_element(polygon, {}, name);
          faces.push_back({next_name(), polygon});
          continue;
        } catch (const Error&) {
          count(split_, p);  // bent by more than an element may be, or without area
          known_.erase(key_of({polygon[0], polygon[1], polygon[2]}));
        }
      }
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) add_triangle(polygon[0], polygon[i], polygon[i + 1], p);
    }
    budget_.take_memory(name, "the faces of a mesh", 300 * (triangles.size() + faces.size()));
    const scene::MergedPolygons merged = scene::merge_coplanar(triangles, [](std::size_t, std::size_t) { return true; });
    if (merged.without_area > 0) {
      count(without_area_, polygon_of[merged.first_without_area]);
      without_area_.count += merged.without_area - 1;
    }
    for (const scene::MergedPolygon& polygon : merged.polygons) {
      try {
        make_element(polygon.outline, polygon.holes, name);
        faces.push_back({next_name(), polygon.outline, polygon.holes});
        continue;
      } catch (const Error&) {
        count(split_, polygon_of[polygon.triangles[0]]);
      }
      for (const std::size_t t : polygon.triangles) faces.push_back({next_name(), {triangles[t].begin(), triangles[t].end()}});
    }
    return faces;
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> result;
    const auto add = [&](const Drops& drops, const std::string& words) {
      if (drops.count > 0) result.push_back(std::to_string(drops.count) + " " + words + "; the first is " + drops.first);
    };
    add(without_area_, "triangles without area dropped");
    add(repeated_, "triangles that repeat another one dropped");
    add(split_, "faces that are bent by more than 1e-6 of their size stay triangles");
    return result;
  }

 private:
  struct Drops {
    std::size_t count = 0;
    std::string first;  // the first one, counted from 1 in its mesh
  };

  Budget& budget_;
  std::map<std::string, std::size_t> numbered_;
  std::set<TriangleKey> known_;
  Drops without_area_, split_, repeated_;
};

std::vector<PolygonMesh> meshes_of(const LoadedScene& loaded) {
  std::vector<PolygonMesh> meshes;
  for (std::size_t m = 0; m < loaded.scene.meshes.size(); ++m) {
    const Mesh& mesh = loaded.scene.meshes[m];
    if (mesh.is_light_shape) continue;
    const auto material = static_cast<std::size_t>(mesh.material);
    PolygonMesh& result = meshes.emplace_back();
    result.name = name_or(mesh.name, "mesh", m);
    result.material = name_or(loaded.scene.materials[material].name, "material", material);
    if (m < loaded.mesh_nodes.size()) result.node = std::to_string(loaded.mesh_nodes[m]);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      std::vector<Vec3d>& corners = result.polygons.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) corners.push_back(static_cast<Vec3d>(mesh.positions[mesh.indices[3 * t + c]]));
    }
  }
  return meshes;
}

}  // namespace

void add_faces(SceneFaces& to, const std::vector<ViewFactorFace>& faces, const FaceOptions& options, Budget& budget) {
  const auto add = [&](const ViewFactorFace& face) {
    to.faces.push_back(face);
    if (options.two_sided) to.faces.push_back(back_of(face));
  };
  for (const ViewFactorFace& face : faces) {
    if (options.divide > 0) {
      for (const ViewFactorFace& element : divided_face(face, options.divide, budget)) add(element);
    } else {
      add(face);
    }
  }
}

SceneFaces faces_of_scene(const LoadedScene& loaded, const FaceOptions& options, Budget& budget) {
  return faces_of_meshes(meshes_of(loaded), options, budget);
}

SceneFaces faces_of_meshes(const std::vector<PolygonMesh>& meshes, const FaceOptions& options, Budget& budget) {
  SceneFaces result;
  std::map<std::string, std::size_t> group_of;
  MeshFaces faces(budget);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const PolygonMesh& mesh = meshes[m];
    const std::string mesh_name = name_or(mesh.name, "mesh", m);
    const std::vector<ViewFactorFace> of_mesh = faces.take(mesh, mesh_name);
    std::size_t group = 0;
    if (options.by != FacesBy::face && !of_mesh.empty()) {
      const std::string name = options.by == FacesBy::node ? mesh_name : name_or(mesh.material, "material", 0);
      // Nodes of one name stay apart.
      const std::string key = options.by == FacesBy::node && !mesh.node.empty() ? mesh.node : name;
      const auto [found, fresh] = group_of.emplace(key, result.group_names.size());
      if (fresh) result.group_names.push_back(name);
      group = found->second;
    }
    add_faces(result, of_mesh, options, budget);
    if (options.by != FacesBy::face) result.groups.resize(result.faces.size(), group);
  }
  result.warnings = faces.warnings();
  return result;
}

}  // namespace steradian::exchange
