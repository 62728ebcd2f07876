#include "exchange/files/vs3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "core/files.h"
#include "exchange/pairs/plane_element.h"
#include "steradian/error.h"

namespace steradian::exchange {
namespace {

struct Vs3Surface {
  char kind = 'S';  // S, N or O
  std::vector<Vec3d> corners;
  std::vector<std::vector<Vec3d>> holes;
  int base = 0, combined = 0;
  std::string name, place;
};

class Vs3Reader {
 public:
  explicit Vs3Reader(std::string path) : path_(std::move(path)) {}

  void read_line(std::string line, std::size_t number) {
    place_ = path_ + ":" + std::to_string(number);
    line.erase(std::min(line.find('!'), line.size()));
    std::istringstream words(line);
    char kind = 0;
    if (!(words >> kind) || kind == '/') return;
    kind = static_cast<char>(std::toupper(static_cast<unsigned char>(kind)));
    switch (kind) {
      case 'T':
      case 'C': return;
      case '*':
      case 'E': ended_ = true; return;
      case 'F': return read_form(words);
      case 'V': return read_vertex(words);
      case 'S':
      case 'N':
      case 'O': return read_surface(words, kind);
      case 'M': throw Error(place_, "masking surfaces (M) are not supported", "make it a surface a little above its base");
      default:
        throw Error(place_, std::string("a line that begins with ") + kind + " is not known", "lines begin with T, C, F, V, S, N, O or E");
    }
  }
  bool has_ended() const { return ended_; }

  // Subsurfaces and null surfaces become holes of their bases.
  std::map<int, Vs3Surface> finish() {
    for (auto& [number, surface] : surfaces_) {
      if (surface.base == 0) continue;
      const auto base = surfaces_.find(surface.base);
      if (base == surfaces_.end() || base->first == number)
        throw Error(surface.place, "its base " + std::to_string(surface.base) + " is no other surface",
                    "give the number of a surface, or 0");
      base->second.holes.push_back(surface.corners);
    }
    return std::move(surfaces_);
  }

 private:
  void read_form(std::istringstream& words) {
    std::string form;
    words >> form;
    if (form != "3") throw Error(place_, "the geometry F " + form + " is not supported", "use F 3, with vertices");
  }
  void read_vertex(std::istringstream& words) {
    int number = 0;
    Vec3d v;
    if (!(words >> number >> v.x >> v.y >> v.z) || !is_finite(v))
      throw Error(place_, "is not V, a number and three coordinates", "V 1 0 0 0");
    vertices_[number] = v;
  }
  void read_surface(std::istringstream& words, char kind) {
    int number = 0;
    std::array<int, 4> corners{};
    Vs3Surface s;
    double emissivity = 0;
    s.kind = kind;
    s.place = place_;
    if (!(words >> number >> corners[0] >> corners[1] >> corners[2] >> corners[3] >> s.base >> s.combined >> emissivity) || number < 1)
      throw Error(place_, "is no surface", "S number v1 v2 v3 v4 base cmb emit name");
    if (!(words >> s.name)) s.name = "surface " + std::to_string(number);
    for (const int c : corners) {
      if (c == 0 && s.corners.size() == 3) break;
      const auto vertex = vertices_.find(c);
      if (vertex == vertices_.end()) throw Error(place_, "the vertex " + std::to_string(c) + " is not there", "give it a V line above");
      s.corners.push_back(vertex->second);
    }
    if (!surfaces_.emplace(number, std::move(s)).second) throw Error(place_, "the surface " + std::to_string(number) + " is given twice");
  }

  std::string path_, place_;
  bool ended_ = false;
  std::map<int, Vec3d> vertices_;
  std::map<int, Vs3Surface> surfaces_;
};

}  // namespace

bool is_vs3_file(const std::string& path) {
  if (path.size() < 4) return false;
  const std::string ending = path.substr(path.size() - 4);
  return ending == ".vs3" || ending == ".VS3";
}

SceneFaces read_vs3(const std::string& path, const FaceOptions& options, Budget& budget) {
  const Bytes bytes = read_file(path, path, budget);
  budget.take_memory(path, "the surfaces of a file", 8 * static_cast<std::uint64_t>(bytes.size()));
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  Vs3Reader reader(path);
  std::string line;
  for (std::size_t number = 1; !reader.has_ended() && std::getline(text, line); ++number) reader.read_line(line, number);

  SceneFaces result;
  std::map<int, std::size_t> group_of;
  const std::map<int, Vs3Surface> surfaces = reader.finish();
  for (const auto& [number, s] : surfaces) {
    if (s.kind == 'N') continue;
    const PlaneElement element = make_element(s.corners, s.holes, s.place + " (" + s.name + ")");
    if (s.kind == 'O') {
      for (const PlaneElement& t : triangles_of_element(element, s.place))
        result.obstacles.push_back({t.contours[0][0], t.contours[0][1], t.contours[0][2]});
      continue;
    }
    add_faces(result, {{s.name, s.corners, s.holes}}, options, budget);
    if (options.by == FacesBy::face) continue;
    const auto whole = surfaces.find(s.combined != 0 ? s.combined : number);
    if (whole == surfaces.end())
      throw Error(s.place, "it is combined with a surface that is not there", "give the number of a surface, or 0");
    const auto [found, fresh] = group_of.emplace(whole->first, result.group_names.size());
    if (fresh) result.group_names.push_back(whole->second.name);
    result.groups.resize(result.faces.size(), found->second);
  }
  return result;
}

}  // namespace steradian::exchange
