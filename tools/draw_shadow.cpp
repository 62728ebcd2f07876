// draw_shadow FILE.svg: a point's view of a light behind two boxes, in four steps, for docs/shadows.md. Steps one and two are the segments
// with their weights and the counts of the regions between them. Steps three and four are the levels with the ray that decides and the
// pieces of the visible part.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "shadow/region/visible_part.h"
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

// One of the four pictures.
class Panel {
 public:
  Panel(std::ostringstream& out, const LightFrame& frame, int column, int row, const char* title) : out_(out), frame_(frame) {
    print("<g transform=\"translate(%.0f %.0f)\">\n<text x=\"%.0f\" y=\"18\" text-anchor=\"middle\">%s</text>\n", column * kWidth,
          row * height(frame), kWidth / 2, title);
  }
  ~Panel() { out_ << "</g>\n"; }
  static double height(const LightFrame& frame) { return kTitle + kWidth * frame.box_y / frame.box_x; }
  static constexpr double kWidth = 380, kTitle = 14;

  // Fills the region within closed chains of pieces.
  void fill(std::vector<Boundary> rest, const char* colour) {
    print("<path fill=\"%s\" fill-rule=\"evenodd\" d=\"", colour);
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
      out_ << "Z";
    }
    out_ << "\"/>\n";
  }
  void line(double ax, double ay, double bx, double by, const char* colour, double width) {
    print("<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-linecap=\"round\"/>\n", x(ax),
          y(ay), x(bx), y(by), colour, width);
  }
  void segments(const SegmentSet& set, double width) {
    for (const Segment& s : set.segments) line(s.a.x, s.a.y, s.b.x, s.b.y, s.source == Source::outline ? "#c08000" : "#888888", width);
  }
  void text(double cx, double cy, const char* words, int size = 14) {
    print("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"%d\">%s</text>\n", x(cx), y(cy) + 5, size, words);
  }
  void dot(double cx, double cy) { print("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"#0072b2\"/>\n", x(cx), y(cy)); }

 private:
  double x(double cell) const { return kWidth / 2 + cell / kCells * kScale; }
  double y(double cell) const { return (kTitle + height(frame_)) / 2 - cell / kCells * kScale * frame_.box_y / frame_.box_x; }
  template <class... T>
  void print(const char* format, T... values) {
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    out_ << text;
  }
  static constexpr double kScale = 0.46 * kWidth;
  std::ostringstream& out_;
  const LightFrame& frame_;
};

// The boundary of the region whose count is at most `level`.
std::vector<Boundary> region_of(const std::vector<Piece>& pieces, std::int32_t level) {
  std::vector<Boundary> result;
  for (const Piece& p : pieces) {
    if (p.low() > level || level >= p.high()) continue;
    if (p.left < p.right)
      result.push_back({p.ax, p.ay, p.bx, p.by});
    else
      result.push_back({p.bx, p.by, p.ax, p.ay});
  }
  return result;
}

double clearance(const SegmentSet& set, double cx, double cy) {
  double room = 1e30;
  for (const Segment& s : set.segments) {
    const double fx = s.b.x - s.a.x, fy = s.b.y - s.a.y,
                 t = std::clamp(((cx - s.a.x) * fx + (cy - s.a.y) * fy) / (fx * fx + fy * fy), 0.0, 1.0);
    room = std::min(room, std::hypot(cx - s.a.x - t * fx, cy - s.a.y - t * fy));
  }
  return room;
}

// A place on the light, with its count and its distance from the segments.
struct Counted {
  double x, y, room;
  std::int32_t count;
};
std::vector<Counted> places_on(const SegmentSet& set) {
  std::vector<Counted> result;
  for (int j = 1; j < 60; ++j)
    for (int i = 1; i < 80; ++i) {
      const double cx = (2 * i / 80.0 - 1) * kCells, cy = (2 * j / 60.0 - 1) * kCells;
      const std::int32_t count = count_at(set, cx, cy);
      if (count < kHidden / 2) result.push_back({cx, cy, clearance(set, cx, cy), count});
    }
  std::sort(result.begin(), result.end(), [](const Counted& a, const Counted& b) { return a.room > b.room; });
  return result;
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

  std::ostringstream out;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << 2 * Panel::kWidth << " " << 2 * Panel::height(frame) + 10
      << "\" font-family=\"sans-serif\" font-size=\"15\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  const std::vector<Counted> places = places_on(scratch.set);
  char text[40];
  {
    Panel panel(out, frame, 0, 0, "1. Segments, each with its jump of the count");
    panel.segments(scratch.set, 1.5);
    for (const Segment& s : scratch.set.segments) {
      if (s.source != Source::edge) continue;
      std::snprintf(text, sizeof text, "%+d", s.weight);
      panel.text(0.5 * (s.a.x + s.b.x) + 0.04 * kCells, 0.5 * (s.a.y + s.b.y) + 0.05 * kCells, text, 12);
    }
  }
  std::set<std::int32_t> levels;
  for (const Counted& place : places) levels.insert(place.count);
  {
    Panel panel(out, frame, 1, 0, "2. Counts of the regions between them");
    const char* const shades[] = {"#ffe9a8", "#c9c9c9", "#9a9a9a", "#707070"};
    std::size_t shade = levels.size();
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)
      panel.fill(region_of(scratch.pieces, *level), shades[std::min(--shade, std::size_t{3})]);
    panel.segments(scratch.set, 1);
    // Labels go to the places with the most space, at most one per neighbourhood.
    std::vector<Counted> said;
    for (const Counted& place : places) {
      const bool near = std::any_of(said.begin(), said.end(), [&](const Counted& c) {
        return c.count == place.count && std::hypot(c.x - place.x, c.y - place.y) < 0.8 * kCells;
      });
      if (near || place.room < 0.06 * kCells) continue;
      said.push_back(place);
      std::snprintf(text, sizeof text, "%d", place.count);
      panel.text(place.x, place.y, text);
    }
  }
  {
    Panel panel(out, frame, 0, 1, "3. The lowest level: one ray says that it is none");
    panel.fill(region_of(scratch.pieces, region.level), "#ffe9a8");
    panel.segments(scratch.set, 1);
    for (const Counted& place : places)
      if (place.count <= region.level) {
        panel.dot(place.x, place.y);
        break;
      }
  }
  {
    Panel panel(out, frame, 1, 1, "4. The pieces that bound what is seen");
    panel.fill(region.boundary, "#ffe9a8");
    for (const Boundary& b : region.boundary) {
      panel.line(b.ax, b.ay, b.bx, b.by, "#c03030", 3);
      for (const auto& [px, py] : {std::pair{b.ax, b.ay}, std::pair{b.bx, b.by}}) panel.line(px, py, px, py, "#000000", 5);
    }
  }
  out << "</svg>\n";
  std::ofstream(argv[1]) << out.str();
}
