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
  char kind = 'S';  // S, M, N or O
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
      case 'M':
      case 'N':
      case 'O': return read_surface(words, kind);
      default:
        throw Error(place_, std::string("a line that begins with ") + kind + " is not known",
                    "lines begin with T, C, F, V, S, M, N, O or E");
    }
  }
  bool has_ended() const { return ended_; }

  // Subsurfaces, masks and null surfaces become holes of their bases.
  std::map<int, Vs3Surface> finish() {
    for (auto& [number, surface] : surfaces_) {
      if (surface.base == 0 && surface.kind != 'M') continue;
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
    bool good = static_cast<bool>(words >> number >> corners[0] >> corners[1] >> corners[2] >> corners[3]) && number >= 1;
    // An obstruction may end behind its corners.
    const bool ends = good && kind == 'O' && !(words >> std::ws).good();
    if (good && !ends) good = static_cast<bool>(words >> s.base >> s.combined >> emissivity);
    if (!good) throw Error(place_, "is no surface", "S number v1 v2 v3 v4 base cmb emit name");
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

// The faces of all surfaces, and their rows of the matrix.
SceneFaces faces_of_surfaces(const std::map<int, Vs3Surface>& surfaces, const FaceOptions& options, Budget& budget) {
  SceneFaces result;
  const bool has_masks = std::any_of(surfaces.begin(), surfaces.end(), [](const auto& s) { return s.second.kind == 'M'; });
  const bool by_face = options.by == FacesBy::face;
  if (has_masks && by_face && options.divide > 0)
    throw UsageError("--divide", "a mask covers parts of several elements", "give --by node, or leave out --divide");
  std::map<int, std::size_t> row_of;  // keys: surfaces, and those with which they are combined
  const auto add_row = [&](const std::string& name) {
    result.group_names.push_back(name);
    return result.group_names.size() - 1;
  };
  const auto add_obstacle = [&](const PlaneElement& element, const std::string& place) {
    for (const PlaneElement& t : triangles_of_element(element, place))
      result.obstacles.push_back({t.contours[0][0], t.contours[0][1], t.contours[0][2]});
  };
  for (const auto& [number, s] : surfaces) {
    if (s.kind == 'N') continue;
    const PlaneElement element = make_element(s.corners, s.holes, s.place + " (" + s.name + ")");
    if (s.kind == 'O') {
      add_obstacle(element, s.place);
    } else if (s.kind == 'M') {
      const Vs3Surface& base = surfaces.at(s.base);
      if (base.kind != 'S') throw Error(s.place, "its base is no radiating surface", "give the number of a surface (S)");
      if (!(dot(element.normal, make_element(base.corners, {}, base.place).normal) < 0))
        throw Error(s.place, "the mask and its base face the same side", "give the corners in the other order");
      add_obstacle(element, s.place);
      row_of[number] = add_row(s.name);
    } else {
      const std::size_t before = result.faces.size();
      add_faces(result, {{s.name, s.corners, s.holes}}, options, budget);
      if (by_face && !has_masks) continue;
      const int whole = s.combined != 0 && !by_face ? s.combined : number;
      if (surfaces.count(whole) == 0)
        throw Error(s.place, "it is combined with a surface that is not there", "give the number of a surface, or 0");
      for (std::size_t face = before; face < result.faces.size(); ++face) {
        const bool fresh = by_face || row_of.count(whole) == 0;
        const std::size_t row = fresh ? add_row(by_face ? result.faces[face].name : surfaces.at(whole).name) : row_of[whole];
        result.groups.push_back(row);
        row_of.emplace(whole, row);
        row_of.emplace(number, row);
      }
    }
  }
  for (const auto& [number, s] : surfaces)
    if (s.kind == 'M') result.masks.push_back({row_of.at(number), row_of.at(s.base), make_element(s.corners, s.holes, s.place).area});
  return result;
}

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

  const std::map<int, Vs3Surface> surfaces = reader.finish();
  return faces_of_surfaces(surfaces, options, budget);
}

}  // namespace steradian::exchange
