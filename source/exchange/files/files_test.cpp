// Files of view factors: what is written comes back, and damage is found.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>

#include "exchange/files/matrix_files.h"
#include "exchange/files/npz.h"
#include "exchange/files/scene_faces.h"
#include "exchange/files/unfinished.h"
#include "exchange/files/vs3.h"
#include "exchange/pairs/plane_element.h"
#include "steradian/error.h"
#include "support/gltf_test_file.h"

namespace steradian::exchange::files_test {
namespace {

using scene::test_path;

std::vector<ViewFactorFace> tetrahedron() {
  const Vec3d a{1, 1, 1}, b{1, -1, -1}, c{-1, 1, -1}, d{-1, -1, 1};
  return {{"a", {a, c, b}}, {"b, with a comma", {a, b, d}}, {"ÄΩ", {a, d, c}}, {"", {b, c, d}}};
}

StoredRun run_of(const std::vector<ViewFactorFace>& faces, int part = 1, int parts = 1) {
  StoredRun run;
  run.run = {"0.1.0", 1e-8, true, part, parts, {}};
  run.faces = faces;
  run.obstacles = {{Vec3d{9, 9, 9}, {9, 8, 9}, {8, 9, 9}}};
  ViewFactorOptions options;
  options.eps = 1e-8;
  options.part = part;
  options.parts = parts;
  run.factors = view_factors(faces, options);
  return run;
}

std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(FactorFiles, AMatrixComesBackWithItsFaces) {
  const StoredRun run = run_of(tetrahedron());
  const std::string path = test_path("tetrahedron.npz");
  write_factors(path, run);
  Budget budget;
  const StoredRun read = read_factors_npz(path, budget);
  EXPECT_EQ(read.factors.names, run.factors.names);
  EXPECT_EQ(read.factors.areas, run.factors.areas);
  EXPECT_EQ(read.factors.row_sums, run.factors.row_sums);
  EXPECT_EQ(read.factors.row_errors, run.factors.row_errors);
  EXPECT_EQ(read.run.eps, 1e-8);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_EQ(read.factors.between(i, j), run.factors.between(i, j));
      EXPECT_EQ(read.factors.error_between(i, j), run.factors.error_between(i, j));
    }
  ASSERT_EQ(read.faces.size(), 4u);
  EXPECT_EQ(read.faces[2].outline, run.faces[2].outline);
  EXPECT_EQ(read.obstacles, run.obstacles);
}

TEST(FactorFiles, GroupsHaveADiagonal) {
  StoredRun run = run_of(tetrahedron());
  run.run.groups = {0, 0, 1, 1};
  run.factors = grouped_view_factors(run.factors, run.run.groups, {"first", "second"});
  const std::string path = test_path("groups.npz");
  write_factors(path, run);
  Budget budget;
  const StoredRun read = read_factors_npz(path, budget);
  EXPECT_EQ(read.factors.own, run.factors.own);
  EXPECT_EQ(read.factors.between(1, 0), run.factors.between(1, 0));
  EXPECT_EQ(read.run.groups, run.run.groups);
}

TEST(FactorFiles, PartsComeBackAsParts) {
  const std::vector<ViewFactorFace> faces = tetrahedron();
  const ViewFactors whole = run_of(faces).factors;
  std::vector<ViewFactors> parts;
  for (int k = 2; k >= 1; --k) {
    const std::string path = test_path("part.npz");
    write_factors(path, run_of(faces, k, 2));
    Budget budget;
    parts.push_back(read_factors_npz(path, budget).factors);
  }
  EXPECT_THROW(merge_view_factors({parts[0]}), Error);
  const ViewFactors merged = merge_view_factors(parts);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(merged.between(i, j), whole.between(i, j));
}

TEST(FactorFiles, DamagedBytesAreRefusedOrHarmless) {
  const StoredRun run = run_of(tetrahedron());
  const std::string path = test_path("damaged.npz");
  write_factors(path, run);
  const std::string good = file_bytes(path);
  for (std::size_t at = 0; at < good.size(); at += 5) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    std::ofstream(path, std::ios::binary) << bad;
    Budget budget;
    try {
      const StoredRun read = read_factors_npz(path, budget);
      EXPECT_EQ(read.factors.between(1, 0), run.factors.between(1, 0)) << "byte " << at;
    } catch (const Error&) {
    }
  }
  for (std::size_t size = 0; size < good.size(); size += 7) {
    std::ofstream(path, std::ios::binary) << good.substr(0, size);
    Budget budget;
    EXPECT_THROW(read_factors_npz(path, budget), Error) << size << " bytes";
  }
}

TEST(FactorFiles, MatrixMarketHasTheLowerTriangle) {
  const std::string path = test_path("tetrahedron.mtx");
  write_factors(path, run_of(tetrahedron()));
  const std::string text = file_bytes(path);
  EXPECT_EQ(text.find("%%MatrixMarket matrix coordinate real symmetric\n"), 0u);
  EXPECT_NE(text.find("\n4 4 6\n2 1 1.1547"), std::string::npos) << text;
  EXPECT_THROW(write_factors(test_path("tetrahedron.txt"), run_of(tetrahedron())), UsageError);
}

TEST(UnfinishedFactors, GoOnAfterTheFileWasCutOff) {
  std::vector<ViewFactorFace> faces;
  for (int i = 0; i < 40; ++i) {
    const double z = 0.1 * i, turn = i % 2 ? 1 : -1;
    faces.push_back({std::to_string(i), {{0, 0, z}, {turn, 0, z}, {turn, 1, z}, {0, 1, z}}});
  }
  const std::string path = test_path("unfinished.part");
  StoredRun run;
  run.run = {"0.1.0", 1e-6, true, 1, 1, {}};
  run.faces = faces;
  ViewFactorOptions options;
  const ViewFactors whole = view_factors(faces, options);
  {
    UnfinishedFactors first(path, run);
    options.finished = [&](const ExchangeBlock& block) { first.add(block); };
    view_factors(faces, options);
  }
  const std::string all = file_bytes(path);
  std::ofstream(path, std::ios::binary) << all.substr(0, all.size() * 2 / 3);
  {
    UnfinishedFactors second(path, run);
    int found = 0, made = 0;
    std::mutex mutex;
    options.known = [&](ExchangeBlock& block) {
      const std::lock_guard lock(mutex);
      const bool is_known = second.find(block);
      found += is_known;
      return is_known;
    };
    options.finished = [&](const ExchangeBlock& block) {
      const std::lock_guard lock(mutex);
      ++made;
      second.add(block);
    };
    const ViewFactors resumed = view_factors(faces, options);
    EXPECT_GT(found, 0);
    EXPECT_GT(made, 0);
    EXPECT_EQ(resumed.row_sums, whole.row_sums);
    EXPECT_EQ(resumed.row_errors, whole.row_errors);
  }
  // Other settings take nothing from it.
  run.run.eps = 1e-5;
  UnfinishedFactors other(path, run);
  ExchangeBlock block = whole.blocks[0];
  EXPECT_FALSE(other.find(block));
  other.remove();
  EXPECT_TRUE(file_bytes(path).empty());
}

TEST(MeshFiles, ReadTheFacesOfACube) {
  // The inside of a unit cube, its lid as two triangles; once more as a PLY file.
  const std::string corners[8] = {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"};
  const std::vector<std::vector<int>> faces = {{0, 1, 2, 3}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}, {4, 7, 6}, {4, 6, 5}};
  std::string obj = "o cube\n",
              ply =
                  "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\nelement face 7\n"
                  "property list uchar int vertex_indices\nend_header\n";
  for (const std::string& c : corners) {
    obj += "v " + c + "\n";
    ply += c + "\n";
  }
  for (const std::vector<int>& f : faces) {
    obj += "f";
    ply += std::to_string(f.size());
    for (const int i : f) {
      obj += " " + std::to_string(i + 1);
      ply += " " + std::to_string(i);
    }
    obj += "\n";
    ply += "\n";
  }
  EXPECT_TRUE(is_mesh_file("A.OBJ"));
  EXPECT_FALSE(is_mesh_file("a.glb"));
  for (const auto& [name, text] : {std::pair{"cube.obj", obj}, {"cube.ply", ply}}) {
    const std::string path = scene::write_test_file(name, text);
    Budget budget;
    try {
      const SceneFaces read = faces_of_meshes(read_mesh_file(path, budget), {}, budget);
      ASSERT_EQ(read.faces.size(), 6u) << name;
      const ViewFactors f = view_factors(read.faces);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(f.row_sums[i], 1, f.row_errors[i]) << name;
      EXPECT_THROW(read_mesh_file(scene::write_test_file(name, "no mesh"), budget), Error) << name;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find("STERADIAN_ASSIMP=ON"), std::string::npos);  // a build without this part
    }
  }
}

TEST(Vs3Files, ReadSurfacesHolesObstructionsAndCombinations) {
  // Two squares with a quarter of the middle plane in between, and beside them a wall with a window, in two parts.
  const std::string head = "T squares\nC encl=0 eps=1.e-4\nF 3\n! a comment\n";
  const std::string vertices =
      "V 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nV 5 0 0 1\nV 6 1 0 1\nV 7 1 1 1\nV 8 0 1 1\nV 9 0 0 .5\nV 10 .5 0 .5\nV 11 .5 .5 .5\nV "
      "12 0 .5 .5\n"
      "V 21 .25 .25 0\nV 22 .75 .25 0\nV 23 .75 .75 0\nV 24 .25 .75 0\n";
  const auto read = [&](const std::string& surfaces, FacesBy by = FacesBy::face) {
    Budget budget;
    FaceOptions options;
    options.by = by;
    return read_vs3(scene::write_test_file("case.vs3", head + vertices + surfaces + "End of data\nnothing here is read"), options, budget);
  };
  const SceneFaces squares = read("S 1 1 2 3 4 0 0 0.5 low ! name\nS 2 7 6 5 8 0 0 0.5 high\nO 3 9 10 11 12 0 0 0.5 screen\n");
  ASSERT_EQ(squares.faces.size(), 2u);
  EXPECT_EQ(squares.faces[1].name, "high");
  ASSERT_EQ(squares.obstacles.size(), 2u);
  ViewFactorOptions options;
  options.eps = 1e-8;
  options.obstacles = squares.obstacles;
  EXPECT_NEAR(view_factors(squares.faces, options).between(0, 1), 0.75 * 0.1998248956983873830416, 1e-9);
  // A window is a surface of its own, and a hole in its base; a null surface is only the hole.
  const SceneFaces window = read("S 1 1 2 3 4 0 0 0.5 wall\nS 2 21 22 23 24 1 0 0.5 window\nS 3 7 6 5 8 0 1 0.5 other\n", FacesBy::node);
  ASSERT_EQ(window.faces.size(), 3u);
  EXPECT_EQ(window.faces[0].holes.size(), 1u);
  EXPECT_EQ(window.groups, (std::vector<std::size_t>{0, 1, 0}));
  EXPECT_EQ(read("S 1 1 2 3 4 0 0 0.5 wall\nN 2 21 24 23 22 1 0 0.5 nothing\n").faces.size(), 1u);
  EXPECT_EQ(read("S 1 1 2 3 0 0 0 0.5 triangle\n").faces[0].outline.size(), 3u);
  for (const char* bad : {"S 1 1 2 3 99 0 0 0.5 x\n", "S 1 1 2 3 4 7 0 0.5 x\n", "S 1 1 2\n", "S 1 1 1 1 1 0 0 0.5 x\n", "F 3a\n", "Q\n",
                          "V 1 0 0\n", "S 1 1 2 3 4 0 0 .5 x\nS 1 1 2 3 4 0 0 .5 x\n"})
    EXPECT_THROW(read(bad), Error) << bad;
}

TEST(SceneFaces, DividedFacesCoverTheFace) {
  Budget budget;
  const ViewFactorFace rectangle{"r", {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}};
  EXPECT_EQ(divided_face(rectangle, 0.5, budget).size(), 8u);
  // A ring.
  const ViewFactorFace ring{"ring", {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}, {{{1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}}}};
  const ViewFactorFace notched{"notch", {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}};
  const ViewFactorFace triangle{"t", {{0, 0, 0}, {3, 0, 0}, {0, 3, 1}}};
  for (const ViewFactorFace& face : {rectangle, ring, triangle, notched})
    for (const double size : {10.0, 1.0, 0.37}) {
      double area = 0;
      for (const ViewFactorFace& part : divided_face(face, size, budget)) area += make_element(part.outline, part.holes, "part").area;
      const double whole = make_element(face.outline, face.holes, "whole").area;
      EXPECT_NEAR(area, whole, 1e-12 * whole) << face.name << " by " << size;
    }
  EXPECT_THROW(divided_face(rectangle, 1e-9, budget), Error);
  // Cuts that run through a hole or a notch leave simple elements, which can obstruct.
  for (const ViewFactorFace& face : {ring, notched})
    for (const double size : {2.0, 1.0, 0.37})
      for (const ViewFactorFace& part : divided_face(face, size, budget))
        EXPECT_TRUE(is_simple(make_element(part.outline, part.holes, part.name))) << part.name << " by " << size;
}

}  // namespace
}  // namespace steradian::exchange::files_test
