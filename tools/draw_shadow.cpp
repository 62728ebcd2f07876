// draw_shadow FILE.svg: what one point sees of a light behind two boxes, as docs/shadows.md shows it: the segments with their
// weights, the counts of the regions between them, and the pieces of the visible part.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "shadow/visible_part.h"
#include "steradian/polygon_light.h"

using namespace steradian;
using namespace steradian::shadow;

namespace {

void add_box(std::vector<Vec3d>& positions, std::vector<std::uint32_t>& indices, Vec3d low, Vec3d high) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (int i = 0; i < 8; ++i)
    positions.push_back({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z});
  for (const unsigned i : {0u, 2u, 3u, 0u, 3u, 1u, 4u, 5u, 7u, 4u, 7u, 6u, 0u, 1u, 5u, 0u, 5u, 4u,
                           2u, 6u, 7u, 2u, 7u, 3u, 0u, 4u, 6u, 0u, 6u, 2u, 1u, 3u, 7u, 1u, 7u, 5u})
    indices.push_back(first + i);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_shadow FILE.svg\n");
    return 2;
  }
  PolygonLight light;
  light.vertices = {{-1, 3, -0.7}, {1, 3, -0.7}, {1, 3, 0.7}, {-1, 3, 0.7}};
  const PreparedPolygon polygon = prepare_polygon(light);
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;
  add_box(positions, indices, {-0.55, 1.2, -0.15}, {0.05, 1.5, 0.2});
  add_box(positions, indices, {-0.15, 1.8, -0.5}, {0.35, 2.0, 0.1});
  const Occluders occluders(build_edges(positions, indices));
  const Viewpoint at{{0.1, 0, 0.05}, {0, 1, 0}, {}};

  const LightFrame frame = light_frame(polygon, polygon.side_of(at.position));
  LocalEdges<double> edges;
  edges.assign_all(occluders.mesh, frame);
  Scratch scratch;
  edges.see(at, scratch.set);
  VisibleRegion region;
  find_visible(frame, at.position, occluders.rays, scratch, region);

  const double scale = 300, width = 2 * scale * 1.08, height = width * frame.box_y / frame.box_x;
  const auto x = [&](double cell) { return width / 2 + cell / kCells * scale; };
  const auto y = [&](double cell) { return height / 2 - cell / kCells * scale * frame.box_y / frame.box_x; };
  std::ostringstream out;
  char text[400];
  const auto print = [&](const char* format, auto... values) {
    std::snprintf(text, sizeof text, format, values...);
    out << text;
  };
  print("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" font-family=\"sans-serif\" font-size=\"15\">\n", width,
        height);
  out << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<path fill=\"#ffe9a8\" fill-rule=\"evenodd\" d=\"";
  // The pieces chained, for the fill alone.
  std::vector<Boundary> rest = region.boundary;
  while (!rest.empty()) {
    Boundary piece = rest.back();
    rest.pop_back();
    print("M%.2f %.2f", x(piece.ax), y(piece.ay));
    for (bool found = true; found;) {
      print("L%.2f %.2f", x(piece.bx), y(piece.by));
      found = false;
      for (std::size_t i = 0; i < rest.size() && !found; ++i)
        if (std::abs(rest[i].ax - piece.bx) + std::abs(rest[i].ay - piece.by) < 1) {
          piece = rest[i];
          rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
          found = true;
        }
    }
    out << "Z";
  }
  out << "\"/>\n";
  for (const Segment& s : scratch.set.segments)
    print("<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", x(s.a.x), y(s.a.y), x(s.b.x),
          y(s.b.y), s.source == Source::outline ? "#c08000" : "#888888");
  for (const Boundary& b : region.boundary)
    print("<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"#c03030\" stroke-width=\"3\"/>\n", x(b.ax), y(b.ay), x(b.bx),
          y(b.by));
  for (const Segment& s : scratch.set.segments) {
    const double mx = 0.5 * (x(s.a.x) + x(s.b.x)), my = 0.5 * (y(s.a.y) + y(s.b.y));
    if (s.source == Source::edge)
      print("<text x=\"%.1f\" y=\"%.1f\" fill=\"#555555\" font-size=\"12\">%+d</text>\n", mx + 4, my - 4, s.weight);
  }
  // A count for every region, where a grid of places first meets it.
  std::set<std::int32_t> said;
  for (int j = 1; j < 24; ++j)
    for (int i = 1; i < 32; ++i) {
      const double cx = (2 * i / 32.0 - 1) * kCells, cy = (2 * j / 24.0 - 1) * kCells;
      const std::int32_t count = count_at(scratch.set, cx, cy);
      double room = 1e30;
      for (const Segment& s : scratch.set.segments) {
        const double fx = s.b.x - s.a.x, fy = s.b.y - s.a.y,
                     t = std::clamp(((cx - s.a.x) * fx + (cy - s.a.y) * fy) / (fx * fx + fy * fy), 0.0, 1.0);
        room = std::min(room, std::hypot(cx - s.a.x - t * fx, cy - s.a.y - t * fy));
      }
      if (room < 0.08 * kCells || count >= kHidden / 2 || !said.insert(count * 4 + (cx > 0) + 2 * (cy > 0)).second) continue;
      print("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%d</text>\n", x(cx), y(cy) + 5, count);
    }
  out << "</svg>\n";
  std::ofstream(argv[1]) << out.str();
}
