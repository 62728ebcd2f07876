// `steradian viewfactor` and `steradian merge` as processes.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.h"
#include "steradian/vector.h"
#include "support/gltf_test_file.h"

namespace steradian::viewfactor_program_test {
namespace {

using nlohmann::json;

// A room of 4 x 3 x 5 m as seen from inside, and a screen on its floor with two sides; material 0: walls, 1: screen.
std::string write_room(const fs::path& path, bool has_ceiling = true) {
  scene::GltfTestFile file;
  json primitives = json::array();
  const auto add = [&](const std::vector<Vec3f>& corners, int material) {
    std::vector<float> numbers;
    for (const Vec3f& v : corners) numbers.insert(numbers.end(), {v.x, v.y, v.z});
    primitives.push_back({{"attributes", {{"POSITION", file.add_floats(numbers, "VEC3")}}},
                          {"indices", file.add_indices({0, 1, 2, 0, 2, 3})},
                          {"material", material}});
  };
  const float x = 4, y = 3, z = 5;
  add({{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}}, 0);
  if (has_ceiling) add({{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}}, 0);
  add({{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}, 0);
  add({{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}}, 0);
  add({{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}}, 0);
  add({{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}}, 0);
  add({{1, 0, 2}, {3, 0, 2}, {3, 1.5f, 2}, {1, 1.5f, 2}}, 1);
  add({{1, 0, 2}, {1, 1.5f, 2}, {3, 1.5f, 2}, {3, 0, 2}}, 1);
  file.json["materials"] = {{{"name", "walls"}}, {{"name", "screen"}}};
  file.json["meshes"] = {{{"name", "room"}, {"primitives", primitives}}};
  file.json["nodes"] = {{{"mesh", 0}, {"name", "room"}}};
  file.json["scenes"] = {{{"nodes", {0}}}};
  std::ofstream(path, std::ios::binary) << file.text();
  return path;
}

double number_behind(const std::string& text, const std::string& label) {
  const std::size_t at = text.find(label);
  return at == std::string::npos ? std::nan("") : std::atof(text.c_str() + at + label.size());
}

TEST_F(Program, ViewFactorsOfARoomAddUpToOneAndVerify) {
  const std::string room = write_room(folder / "room.gltf"), file = folder / "room.npz", report = folder / "room.json";
  const Outcome made = run({"viewfactor", room, "-o", file, "--report", report, "--divide", "2"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("guarantees       hold"), std::string::npos) << made.out;
  const json facts = json::parse(contents(report));
  for (std::size_t i = 0; i < facts["row_sums"].size(); ++i)
    EXPECT_NEAR(facts["row_sums"][i].get<double>(), 1, facts["row_errors"][i].get<double>() + 1e-12) << facts["names"][i];
  EXPECT_LT(facts["worst_row_error"].get<double>(), 1e-5);
  for (const auto& [name, verdict] : facts["guarantees"].items()) EXPECT_EQ(verdict, "pass") << name;
  const Outcome verified = run({"viewfactor", "verify", file, "--pairs", "100"});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  EXPECT_EQ(number_behind(verified.out, "beyond the error"), 0) << verified.out;
}

TEST_F(Program, ViewFactorPartsMergeToTheSameBytes) {
  const std::string room = write_room(folder / "room.gltf"), whole = folder / "whole.npz", merged = folder / "merged.npz";
  ASSERT_EQ(run({"viewfactor", room, "-o", whole, "--eps", "1e-5"}).status, 0);
  std::vector<std::string> command = {"merge"};
  for (const char* part : {"2/3", "3/3", "1/3"}) {
    command.push_back(folder / (std::string("part") + part[0] + ".npz"));
    ASSERT_EQ(run({"viewfactor", room, "-o", command.back(), "--eps", "1e-5", "--part", part}).status, 0);
  }
  command.insert(command.end(), {"-o", merged});
  const Outcome joined = run(command);
  ASSERT_EQ(joined.status, 0) << joined.err;
  EXPECT_EQ(contents(merged), contents(whole));
  // A gap, and parts of another run.
  const Outcome gap = run({"merge", command[1], command[2], "-o", merged});
  EXPECT_EQ(gap.status, 1);
  EXPECT_NE(gap.err.find("missing"), std::string::npos) << gap.err;
  ASSERT_EQ(run({"viewfactor", room, "-o", command[3], "--eps", "1e-4", "--part", "1/3"}).status, 0);
  const Outcome mixed = run({"merge", command[1], command[2], command[3], "-o", merged});
  EXPECT_EQ(mixed.status, 1);
  EXPECT_NE(mixed.err.find("other settings"), std::string::npos) << mixed.err;
  EXPECT_EQ(contents(merged), contents(whole));  // nothing half written
}

// Groups, masks, closing and small factors wait for the whole matrix: merge takes them from the parts.
TEST_F(Program, ViewFactorPartsOfGroupsMergeToTheSameBytes) {
  const std::string room = write_room(folder / "room.gltf"), masked = folder / "masked.vs3";
  std::ofstream(masked) << "F 3\nV 1 0 0 0\nV 2 4 0 0\nV 3 4 5 0\nV 4 0 5 0\nV 5 0 0 3\nV 6 4 0 3\nV 7 4 5 3\nV 8 0 5 3\n"
                           "V 9 1 1 0\nV 10 3 1 0\nV 11 3 3 0\nV 12 1 3 0\nS 1 1 2 3 4 0 0 .5 floor\nS 2 8 7 6 5 0 0 .5 ceiling\n"
                           "S 3 1 5 6 2 0 0 .5 south\nS 4 3 7 8 4 0 0 .5 north\nM 5 12 11 10 9 1 0 .5 carpet\n";
  const struct {
    std::string scene;
    std::vector<std::string> options, last;
  } runs[] = {{room, {"--by", "material"}, {"--close"}},
              {room, {"--by", "node"}, {"--drop", "10"}},
              {masked, {}, {}},
              {masked, {"--by", "node", "--divide", "2"}, {}}};
  for (const auto& r : runs) {
    const std::string whole = folder / "whole.npz", merged = folder / "merged.npz", report = folder / "merged.json";
    std::vector<std::string> one = {"viewfactor", r.scene, "-o", whole}, merge = {"merge", "-o", merged, "--report", report};
    one.insert(one.end(), r.options.begin(), r.options.end());
    for (const char* part : {"1/2", "2/2"}) {
      std::vector<std::string> command = one;
      merge.push_back(command[3] = folder / (std::string("part") + part[0] + ".npz"));
      command.insert(command.end(), {"--part", part});
      const Outcome made = run(command);
      ASSERT_EQ(made.status, 0) << made.err;
    }
    one.insert(one.end(), r.last.begin(), r.last.end());
    merge.insert(merge.end(), r.last.begin(), r.last.end());
    ASSERT_EQ(run(one).status, 0);
    const Outcome joined = run(merge);
    ASSERT_EQ(joined.status, 0) << joined.err;
    EXPECT_EQ(contents(merged), contents(whole)) << r.scene;
    EXPECT_EQ(json::parse(contents(report))["guarantees"].size(), 2u);
  }
  // A mask sees its base alone.
  const std::string text = folder / "masked.mtx";
  ASSERT_EQ(run({"viewfactor", masked, "-o", text}).status, 0);
  EXPECT_NE(contents(text).find("\n5 1 4\n"), std::string::npos) << contents(text);
  EXPECT_EQ(contents(text).find("\n5 2 "), std::string::npos);
}

TEST_F(Program, ViewFactorsByMaterialCloseAndResume) {
  const std::string room = write_room(folder / "room.gltf"), file = folder / "room.mtx", plain = folder / "plain.npz",
                    again = folder / "again.npz";
  const Outcome made = run({"viewfactor", room, "-o", file, "--by", "material", "--close"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("groups           2"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("row sums         1 to 1"), std::string::npos) << made.out;
  EXPECT_NE(contents(file).find("\n2 2 2\n"), std::string::npos) << contents(file);
  ASSERT_EQ(run({"viewfactor", room, "-o", plain}).status, 0);
  ASSERT_EQ(run({"viewfactor", room, "-o", again, "--resume"}).status, 0);
  EXPECT_EQ(contents(plain), contents(again));
  EXPECT_FALSE(fs::exists(again + ".part"));
}

TEST_F(Program, ViewFactorPointsLeaveTheSky) {
  const std::string room = write_room(folder / "room.gltf", false);
  std::ofstream(folder / "sensors.csv") << "x,y,z,nx,ny,nz\n2,0,1,0,1,0\n# a comment\n2,2.9,2.5,0,2,0\n";
  const Outcome made = run({"viewfactor", "points", room, folder / "sensors.csv", "--by", "material"});
  ASSERT_EQ(made.status, 0) << made.err;
  std::istringstream lines(made.out);
  std::string heading, first, second;
  std::getline(lines, heading);
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_EQ(heading, "x,y,z,nx,ny,nz,sky,backs,walls,screen");
  const auto column = [](std::string line, int number) {
    for (; number > 0; --number) line = line.substr(line.find(',') + 1);
    return std::atof(line.c_str());
  };
  EXPECT_NEAR(column(first, 6) + column(first, 7) + column(first, 8) + column(first, 9), 1, 1e-12);
  EXPECT_GT(column(first, 9), 0.05);
  EXPECT_GT(column(second, 6), 0.9);
}

TEST_F(Program, ViewFactorRefusesWrongUse) {
  const std::string room = write_room(folder / "room.gltf"), file = folder / "room.npz";
  const auto refuses = [&](std::vector<std::string> arguments, int status, const std::string& words) {
    arguments.insert(arguments.begin(), "viewfactor");
    const Outcome r = run(arguments);
    EXPECT_EQ(r.status, status) << r.err;
    EXPECT_NE(r.err.find(words), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(file));
  };
  refuses({room, "-o", folder / "room.csv"}, 2, ".npz, .h5, .mtx or .vf");
  refuses({room, "-o", file, "--part", "4/3"}, 2, "--part");
  refuses({room, "-o", file, "--part", "1/2", "--close"}, 2, "merge");
  refuses({room}, 2, "-o");
  refuses({folder / "none.gltf", "-o", file}, 1, "none.gltf");
  refuses({room, "-o", file, "--divide", "1e-7"}, 1, "--divide");
  refuses({write_room(folder / "open.gltf", false), "-o", file, "--close"}, 1, "hole");
  refuses({"points", room, room}, 1, "sensors");
  refuses({"verify", room}, 1, "ZIP");
}

}  // namespace
}  // namespace steradian::viewfactor_program_test
