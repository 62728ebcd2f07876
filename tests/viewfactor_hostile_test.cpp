// `steradian viewfactor` on strange and damaged files in all formats: an error or factors from 0 to 1, and a warning where rows are
// above 1.
#include <array>
#include <cmath>
#include <random>

#include "exchange/files/matrix_files.h"
#include "night.h"
#include "program.h"
#include "support/gltf_test_file.h"

namespace steradian::viewfactor_hostile_test {
namespace {

using Polygons = std::vector<std::vector<Vec3d>>;

// Faces on a coarse grid half of the time, so that corners, edges and planes meet; at any scale from 1e-6 to 1e6 m.
class StrangeScene {
 public:
  explicit StrangeScene(unsigned seed) : random_(seed), scale_(std::pow(10.0, 2 * whole(-3, 3))), is_coarse_(whole(0, 1) == 1) {}

  Polygons polygons() {
    Polygons result;
    for (int i = whole(0, 7); i > 0; --i) add_to(result);
    for (std::vector<Vec3d>& polygon : result)
      for (Vec3d& v : polygon) v *= scale_;
    return result;
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

 private:
  double number() {
    const double x = std::uniform_real_distribution<double>(-1, 1)(random_);
    return is_coarse_ ? std::round(2 * x) / 2 : x;
  }
  Vec3d point() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  void add_to(Polygons& to) {
    const Vec3d o = point(), a = point(), b = point();
    const std::vector<Vec3d> quad{o, o + a, o + a + b, o + b};
    switch (whole(0, 12)) {
      case 0: return to.push_back({o, o + a, o + b});
      case 1: return to.push_back({o, o + a, o + a * 2.0});
      case 2: return to.push_back({o, o, o, o});
      case 3: return to.push_back({o, o + a, o + a + b + cross(a, b) * 0.1, o + b});
      case 4: return to.push_back({o, o + a, o + b, o + a + b});
      case 5: return to.push_back({o, o + a, {std::nan(""), 0, 0}});
      case 6: return to.push_back({o * 1e6, (o + a) * 1e6, (o + b) * 1e6});
      case 7: return to.push_back({o, o + a * 1e-6, o + b * 1e-6});
      case 8: return to.push_back(to.empty() ? quad : to.back());
      case 9:  // the same plane, overlapping
        to.push_back(quad);
        return to.push_back({o + a * 0.3, o + a * 1.3, o + a * 1.3 + b, o + a * 0.3 + b});
      case 10: {  // a face close before another one
        const Vec3d lifted = o + cross(a, b) * std::pow(10.0, whole(-9, -1));
        to.push_back(quad);
        return to.push_back({lifted, lifted + b, lifted + a + b, lifted + a});
      }
      case 11: {  // a box, now and then with a hole
        for (const auto& [u, v, w] : {std::array{a, b, o}, std::array{b, o, a}, std::array{o, a, b}}) {
          if (whole(0, 9) > 0) to.push_back({{}, u, u + v, v});
          if (whole(0, 9) > 0) to.push_back({w, w + v, w + u + v, w + u});
        }
        return;
      }
      default: return to.push_back(quad);
    }
  }

  std::mt19937 random_;
  double scale_;
  bool is_coarse_;
};

std::string text_of(Vec3d v) { return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n"; }

std::string obj_of(const Polygons& polygons) {
  std::string text;
  for (const auto& polygon : polygons) {
    for (const Vec3d& v : polygon) text += "v " + text_of(v);
    text += "f";
    for (std::size_t i = polygon.size(); i > 0; --i) text += " -" + std::to_string(i);
    text += "\n";
  }
  return text;
}

std::string stl_of(const Polygons& polygons) {
  std::string text = "solid scene\n";
  for (const auto& p : polygons)
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const Vec3d& v : {p[0], p[i], p[i + 1]}) text += "vertex " + text_of(v);
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid scene\n";
}

std::string ply_of(const Polygons& polygons) {
  std::string vertices, faces;
  std::size_t count = 0;
  for (const auto& polygon : polygons) {
    faces += std::to_string(polygon.size());
    for (const Vec3d& v : polygon) {
      vertices += text_of(v);
      faces += " " + std::to_string(count++);
    }
    faces += "\n";
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(polygons.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

std::string vs3_of(const Polygons& polygons) {
  std::string vertices, surfaces;
  std::size_t count = 0, number = 0;
  for (const auto& polygon : polygons) {
    surfaces += "S " + std::to_string(++number);
    for (std::size_t i = 0; i < 4; ++i) {
      if (i < polygon.size()) vertices += "V " + std::to_string(++count) + " " + text_of(polygon[i]);
      surfaces += " " + std::to_string(i < polygon.size() ? count : 0);
    }
    surfaces += " 0 0 0.9 s" + std::to_string(number) + "\n";
  }
  return "F 3\n" + vertices + surfaces + "E\n";
}

std::string gltf_of(const Polygons& polygons) {
  scene::GltfTestFile file;
  nlohmann::json nodes = nlohmann::json::array();
  for (const auto& p : polygons) {
    std::vector<float> corners;
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
      for (const Vec3d& v : {p[0], p[i], p[i + 1]})
        for (const double x : {v.x, v.y, v.z}) corners.push_back(static_cast<float>(x));
    const int mesh = file.append("meshes", {{"primitives", {{{"attributes", {{"POSITION", file.add_floats(corners, "VEC3")}}}}}}});
    nodes.push_back(file.append("nodes", {{"mesh", mesh}}));
  }
  file.json["scenes"] = {{{"nodes", nodes}}};
  return file.text();
}

class HostileFactorFiles : public Program {
 protected:
  void check(const std::string& ending, const std::string& text, const std::string& what) {
    const std::string path = folder / ("scene." + ending), file = folder / "factors.npz";
    fs::remove(file);
    std::ofstream(path, std::ios::binary) << text;
    const Outcome o = run_limited({"viewfactor", path, "-o", file, "--eps", "1e-3"}, [] {
      const rlimit seconds{120, 120};
      setrlimit(RLIMIT_CPU, &seconds);
    });
    ASSERT_TRUE(o.status == 0 || o.status == 1) << what << ": status " << o.status << ", " << o.err;
    EXPECT_LT(o.err.size(), 4000u) << what;
    EXPECT_EQ(fs::exists(file), o.status == 0) << what;
    if (o.status == 1) {
      EXPECT_NE(o.err.find(path), std::string::npos) << what << ": " << o.err;
      return;
    }
    Budget budget{Limits{}};
    const ViewFactors f = exchange::read_factors_npz(file, budget).factors;
    for (std::size_t i = 0; i < f.size(); ++i) {
      EXPECT_TRUE(f.row_sums[i] <= 1 + f.row_errors[i] + 1e-12 || o.err.find("add up to more than 1") != std::string::npos)
          << what << ", row " << i;
      for (std::size_t j = 0; j < i; ++j) {
        const double h = f.between(i, j);
        EXPECT_TRUE(h >= 0 && h <= std::min(f.areas[i], f.areas[j])) << what << ", pair " << i << ", " << j << ": " << h;
      }
    }
    ++computed_;
  }
  int computed_ = 0;
};

TEST_F(HostileFactorFiles, GiveAnErrorOrFactorsFromZeroToOne) {
  const unsigned count = test::by_day_or_night(6u, 200u);
  for (unsigned seed = 0; seed < count; ++seed) {
    StrangeScene scene(seed);
    const Polygons polygons = scene.polygons();
    const std::pair<const char*, std::string> files[] = {{"obj", obj_of(polygons)},
                                                         {"stl", stl_of(polygons)},
                                                         {"ply", ply_of(polygons)},
                                                         {"vs3", vs3_of(polygons)},
                                                         {"gltf", gltf_of(polygons)}};
    for (const auto& [ending, whole] : files) {
      std::string text = whole;
      const auto place = [&] { return static_cast<std::size_t>(scene.whole(0, static_cast<int>(text.size()) - 1)); };
      const int damage = text.empty() ? 7 : scene.whole(0, 7);
      if (damage == 0) text.resize(place());
      if (damage == 1)
        for (int i = 0; i < 3; ++i) text[place()] = static_cast<char>(scene.whole(0, 255));
      check(ending, text, "seed " + std::to_string(seed) + " " + ending);
    }
  }
  EXPECT_GT(computed_, static_cast<int>(count));
}

}  // namespace
}  // namespace steradian::viewfactor_hostile_test
