#include "exchange/obstacles/scene_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "steradian/error.h"

namespace steradian::exchange {
namespace {

std::string place_of_face(const std::vector<ViewFactorFace>& faces, std::size_t i) {
  return "face " + std::to_string(i) + (faces[i].name.empty() ? "" : " (" + faces[i].name + ")");
}

// The triangles of all elements, each once: the back of a two-sided face has those of its front.
class DistinctTriangles {
 public:
  void add(const PlaneElement& element, std::size_t number, const std::string& place) {
    for (const PlaneElement& t : triangles_of_element(element, place)) {
      std::array<std::array<double, 3>, 3> key;
      for (std::size_t c = 0; c < 3; ++c) key[c] = {t.contours[0][c].x, t.contours[0][c].y, t.contours[0][c].z};
      std::sort(key.begin(), key.end());
      const auto [found, fresh] = known_.emplace(key, triangles.size());
      if (fresh) {
        triangles.push_back({t.contours[0][0], t.contours[0][1], t.contours[0][2]});
        elements.emplace_back();
      }
      elements[found->second].push_back(number);
    }
  }

  std::vector<ObstacleTriangle> triangles;
  std::vector<std::vector<std::size_t>> elements;  // by triangle

 private:
  std::map<std::array<std::array<double, 3>, 3>, std::size_t> known_;
};

void share_plane(PlaneElement& e, const ObstacleFace& plane) {
  if (dot(e.normal, plane.normal) < 0)
    e.normal = -plane.normal;
  else
    e.normal = plane.normal;
  e.off_plane = std::max(e.off_plane, plane.off_plane);
}

void share_planes(std::vector<PlaneElement>& elements, const DistinctTriangles& distinct) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max(), kSeveral = kNone - 1;
  const scene::MergedPolygons merged = scene::merge_coplanar(distinct.triangles, [](std::size_t, std::size_t) { return true; });
  std::vector<ObstacleFace> planes;
  std::vector<std::size_t> plane_of(elements.size(), kNone);
  for (const scene::MergedPolygon& polygon : merged.polygons) {
    planes.push_back(plane_of_triangles(distinct.triangles, polygon.triangles));
    double size = 0;
    for (const std::size_t t : polygon.triangles)
      for (const Vec3d& v : distinct.triangles[t]) size = std::max(size, length(v - planes.back().point));
    const bool is_plane = planes.back().off_plane <= kOffPlane * size;
    for (const std::size_t t : polygon.triangles)
      for (const std::size_t e : distinct.elements[t])
        plane_of[e] = is_plane && (plane_of[e] == kNone || plane_of[e] == planes.size() - 1) ? planes.size() - 1 : kSeveral;
  }
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (plane_of[e] < kSeveral) share_plane(elements[e], planes[plane_of[e]]);
}

}  // namespace

SceneElements scene_elements(const std::vector<ViewFactorFace>& faces, const std::vector<ObstacleTriangle>& extra, Obstruction obstruction,
                             AskedFrom from) {
  SceneElements scene;
  DistinctTriangles distinct;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const std::string place = place_of_face(faces, i);
    scene.elements.push_back(make_element(faces[i].outline, faces[i].holes, place));
    try {
      distinct.add(scene.elements.back(), i, place);
    } catch (const Error&) {
      // Integrals along a contour take an outline that touches itself; as an obstacle it has no triangles.
      if (obstruction == Obstruction::on) throw;
    }
  }
  share_planes(scene.elements, distinct);
  if (obstruction == Obstruction::off) return scene;
  std::vector<ObstacleTriangle> triangles = extra;
  triangles.insert(triangles.end(), distinct.triangles.begin(), distinct.triangles.end());
  scene.obstacles = from == AskedFrom::points ? Obstacles(triangles) : Obstacles(triangles, scene.elements);
  return scene;
}

}  // namespace steradian::exchange
