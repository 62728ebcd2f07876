#include "shadow/region/visible_part.h"

#include "shadow/region/visible.h"

namespace steradian::shadow {

PreparedPolygon light_of(const VisibleRegion& region, const PreparedPolygon& light, const LightFrame& frame, int side,
                         const Viewpoint& from, double lift) {
  PreparedPolygon part;
  part.normal = light.normal;
  part.centroid = light.centroid;
  part.area = light.area;
  part.radiance = light.radiance;
  part.two_sided = light.two_sided;
  part.contours.reserve(region.boundary.size() + 1);
  part.vertices.reserve(2 * region.boundary.size());
  part.contours.push_back(0);
  const auto place = [&](Vec3d relative) {
    const double least = lift * length(relative), height = dot(relative, from.normal);
    return from.position + (height < least ? relative + from.normal * (least - height) : relative);
  };
  for (const Boundary& piece : region.boundary) {
    const WorldPiece w = relative_to(from.position, frame, piece);
    // A light that is seen from behind is walked the wrong way round; integrals turn the direction back.
    part.vertices.push_back(place(side < 0 ? w.b : w.a));
    part.vertices.push_back(place(side < 0 ? w.a : w.b));
    part.contours.push_back(part.vertices.size());
  }
  return part;
}

Occluders::Occluders(EdgeMesh m) : mesh(std::move(m)), rays(mesh) {
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) reach = std::max(reach, largest_coordinate(mesh.vertices[v]));
}

Occluders Occluders::cut_by(const Body& body) const {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  return Occluders(build_edges(mesh.vertices, indices, {&body, 1}));
}

PreparedPolygon visible_part(const PreparedPolygon& light, const Occluders& occluders, const Viewpoint& from, double lift,
                             const Body* body) {
  VisibleRegion region;
  const int side = light.side_of(from.position);
  if (side == 0 || (side < 0 && !light.two_sided)) return light_of(region, light, {}, 0, from, lift);
  LightFrame frame = light_frame(light, side);
  frame.body = body;
  LocalEdges<double> edges;
  const auto& inside = occluders.mesh.inside;
  edges.assign_all(occluders.mesh, frame,
                   body != nullptr && !inside.empty() ? std::span<const std::uint32_t>(inside[0]) : std::span<const std::uint32_t>());
  Scratch scratch;
  edges.see(from, scratch.set);
  find_visible(frame, from.position, occluders.rays, scratch, region);
  return light_of(region, light, frame, side, from, lift);
}

}  // namespace steradian::shadow
