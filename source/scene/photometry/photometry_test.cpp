// Files written here by the layouts of the standards, compared with the functions that they tabulate.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "steradian/error.h"
#include "steradian/light_profile.h"
#include "steradian/load_scene.h"
#include "steradian/render.h"
#include "support/gltf_test_file.h"

namespace steradian::photometry_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::vector<double> steps(double from, double to, double step) {
  std::vector<double> result;
  for (double x = from; x <= to + 1e-9; x += step) result.push_back(x);
  return result;
}

std::string numbers(const std::vector<double>& v) {
  std::string text;
  for (std::size_t i = 0; i < v.size(); ++i) text += std::to_string(v[i]) + ((i + 1) % 10 == 0 ? "\n" : " ");
  return text + "\n";
}

using Candela = std::function<double(double vertical, double horizontal)>;

struct Ies {
  std::string head = "IESNA:LM-63-2002\n[TEST] made up\n[MANUFAC] nobody\nTILT=NONE\n";
  std::string factors = "1 1000 1";  // lamps, lumens, multiplier
  std::string ballast = "1 1 30";    // ballast, future use, watts
  int type = 1;
  std::vector<double> vertical = steps(0, 90, 5), horizontal = {0};
  Candela candela = [](double v, double) { return 100 * std::cos(v * kDegree); };

  std::string text() const {
    std::vector<double> values;
    for (const double h : horizontal)
      for (const double v : vertical) values.push_back(std::max(0.0, candela(v, h)));
    return head + factors + " " + std::to_string(vertical.size()) + " " + std::to_string(horizontal.size()) + " " + std::to_string(type) +
           " 2 0.1 0.2 0\n" + ballast + "\n" + numbers(vertical) + numbers(horizontal) + numbers(values);
  }
};

LightProfile read(const std::string& text, const std::string& name = "lamp.ies") { return read_light_profile_from_memory(text, name); }
LightProfile read(const Ies& ies) { return read(ies.text()); }

Vec3d direction_c(double v, double h) {
  return {std::sin(v * kDegree) * std::cos(h * kDegree), std::sin(v * kDegree) * std::sin(h * kDegree), std::cos(v * kDegree)};
}

// Intensity of a lamp that is symmetric about both planes.
double oval(double v, double h) {
  return 10 + 50 * std::pow(std::cos(v * kDegree / 2), 2) + 20 * std::sin(v * kDegree) * std::cos(2 * h * kDegree);
}

TEST(LightProfile, AnswersWhatWasMeasured) {
  const LightProfile lambert = read(Ies{});
  for (const double v : {0.0, 5.0, 45.0, 85.0})
    for (const double h : {0.0, 77.0, 200.0}) EXPECT_NEAR(intensity(lambert, direction_c(v, h)), 100 * std::cos(v * kDegree), 1e-4) << v;
  EXPECT_NEAR(intensity(lambert, direction_c(47.5, 10)), 50 * (std::cos(45 * kDegree) + std::cos(50 * kDegree)), 1e-4);  // linear
  EXPECT_EQ(intensity(lambert, {0, 0, -1}), 0);
  EXPECT_EQ(intensity(lambert, {0, 0, 0}), 0);
  EXPECT_NEAR(intensity(lambert, {0, 0, 7}), 100, 1e-4);
  EXPECT_EQ(lambert.rated_lumens, 1000);
}

// Files may have different values at the poles in every plane. Roundings of a direction must not choose among them.
TEST(LightProfile, PolesHaveTheFirstPlanesValue) {
  LightProfile c;
  c.vertical = {0, 90, 180};
  c.horizontal = {0, 180};
  c.candela = {1, 2, 3, 4, 5, 6};
  LightProfile b;
  b.type = LightProfile::Type::b;
  b.vertical = {-180, 0, 180};
  b.horizontal = {-90, 90};
  b.candela = {1, 2, 3, 4, 5, 6};
  for (const double x : {0.0, -0.0, 1e-9, -1e-9})
    for (const double y : {0.0, -0.0, 1e-9, -1e-9}) {
      EXPECT_NEAR(intensity(c, {x, y, 1}), 1, 1e-6) << x << " " << y;
      EXPECT_NEAR(intensity(c, {x, y, -1}), 3, 1e-6) << x << " " << y;
      EXPECT_NEAR(intensity(b, {x, -1, y}), 5, 1e-6) << x << " " << y;
      EXPECT_NEAR(intensity(b, {x, 1, y}), 2, 1e-6) << x << " " << y;
    }
}

TEST(LightProfile, SymmetriesAreWrittenOut) {
  Ies whole;
  whole.vertical = steps(0, 180, 15);
  whole.horizontal = steps(0, 360, 15);
  whole.candela = oval;
  const LightProfile expected = read(whole);
  for (const auto& planes : {steps(0, 90, 15), steps(0, 180, 15), steps(90, 270, 15), steps(0, 345, 15)}) {
    Ies part = whole;
    part.horizontal = planes;
    const LightProfile got = read(part);
    EXPECT_EQ(got.horizontal, expected.horizontal) << planes.back();
    for (double v = 0; v <= 180; v += 7)
      for (double h = 0; h < 360; h += 11)
        EXPECT_NEAR(intensity(got, direction_c(v, h)), intensity(expected, direction_c(v, h)), 1e-9)
            << v << " " << h << " " << planes.back();
  }
}

TEST(LightProfile, PlanesRunCounterClockwise) {
  Ies lopsided;
  lopsided.horizontal = steps(0, 360, 30);
  lopsided.candela = [](double, double h) { return 100 + h * (360 - h) * (h < 180 ? 1 : 0.5); };
  const LightProfile profile = read(lopsided);
  EXPECT_NEAR(intensity(profile, direction_c(60, 90)), 100 + 90 * 270, 1e-3);
  EXPECT_NEAR(intensity(profile, direction_c(60, 270)), 100 + 90 * 270 / 2, 1e-3);
}

// The polar axis of type b is horizontal. The vertical angle turns about it; the horizontal angle is measured towards it.
Vec3d direction_b(double v, double h) {
  return {std::cos(h * kDegree) * std::sin(v * kDegree), -std::sin(h * kDegree), std::cos(h * kDegree) * std::cos(v * kDegree)};
}

TEST(LightProfile, TypeBTurnsAboutTheHorizontalAxis) {
  Ies flood;
  flood.type = 2;
  flood.vertical = steps(-90, 90, 10);
  flood.horizontal = steps(-90, 90, 10);
  flood.candela = [](double v, double h) { return 1000 * std::exp(-v * v / 900 - h * h / 400) + 3 * (h > 0 ? h : 0) + (v > 0 ? v : 0); };
  const LightProfile whole = read(flood);
  for (const double v : {-80.0, -30.0, 0.0, 20.0, 90.0})
    for (const double h : {-70.0, 0.0, 10.0, 80.0})
      EXPECT_NEAR(intensity(whole, direction_b(v, h)), flood.candela(v, h), 1e-3) << v << " " << h;
  EXPECT_EQ(intensity(whole, {0.1, 0, -1}), 0);

  flood.candela = [](double v, double h) { return 1000 * std::exp(-v * v / 900 - h * h / 400); };
  const LightProfile even = read(flood);
  flood.vertical = flood.horizontal = steps(0, 90, 10);
  const LightProfile quarter = read(flood);
  for (double v = -88; v < 90; v += 13)
    for (double h = -88; h < 90; h += 9) EXPECT_NEAR(intensity(quarter, direction_b(v, h)), intensity(even, direction_b(v, h)), 1e-9);
}

// Midpoint rule over the sphere. The integrand has kinks at the measured angles, so the error is of the order of a step's square.
double flux_by_quadrature(const LightProfile& profile) {
  constexpr int kZ = 3000, kPhi = 720;
  double sum = 0;
  for (int i = 0; i < kZ; ++i) {
    const double z = -1 + 2 * (i + 0.5) / kZ, s = std::sqrt(1 - z * z);
    for (int k = 0; k < kPhi; ++k) {
      const double phi = 2 * std::numbers::pi * (k + 0.5) / kPhi;
      sum += intensity(profile, {s * std::cos(phi), s * std::sin(phi), z});
    }
  }
  return sum * 4 * std::numbers::pi / (kZ * kPhi);
}

TEST(LightProfile, FluxIsTheIntegralOfTheIntensity) {
  Ies fine;
  fine.vertical = steps(0, 90, 0.5);
  EXPECT_NEAR(luminous_flux(read(fine)), 100 * std::numbers::pi,
              100 * std::numbers::pi * 2e-5);  // chords of a cosine in steps of 0.5 degrees: 6e-6
  Ies c;
  c.vertical = steps(0, 180, 15);
  c.horizontal = steps(0, 90, 22.5);
  c.candela = oval;
  Ies b;
  b.type = 2;
  b.vertical = steps(-90, 90, 10);
  b.horizontal = steps(-40, 60, 10);
  b.candela = [](double v, double h) { return 1000 * std::exp(-v * v / 900 - h * h / 400) + h + 50; };
  for (const Ies& ies : {c, b}) {
    const LightProfile profile = read(ies);
    const double flux = luminous_flux(profile);
    // A profile that ends before its edge is dark has a jump there. The jump is off by a point in 720, or in 3000.
    EXPECT_NEAR(flux, flux_by_quadrature(profile), (ies.type == 1 ? 1e-5 : 1e-3) * flux);
  }
}

TEST(Ies, EveryVersionIsRead) {
  Ies ies;
  const double middle = intensity(read(ies), {0, 0, 1});
  for (const char* head :
       {"a lamp\nof 1986, without keywords\nTILT=NONE\n", "IESNA91\n[TEST] 1\nTILT=NONE\n", "IESNA:LM-63-1995\r\n[TEST]\r\nTILT=NONE\r\n",
        "IESNA:LM-63-2002\n[TEST]\nTILT=NONE\n", "IES:LM-63-2019\n[TEST]\n  TILT=NONE\n",
        "IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n", "IESNA91\nTILT=lamp.tlt\n", "Tilt=5 in this room\n tilt = none\n"}) {
    ies.head = head;
    EXPECT_EQ(intensity(read(ies), {0, 0, 1}), middle) << head;
  }
  std::string text = Ies{}.text();
  for (char& c : text)
    if (c == '\n') c = '\r';
  EXPECT_EQ(intensity(read(text), {0, 0, 1}), middle);
  EXPECT_EQ(intensity(read(Ies{}.text() + "\n \x1a"), {0, 0, 1}), middle);
}

// The optional parts of each version before its numbers and among them, for both types.
TEST(Ies, EveryVersionIsReadInBothTypes) {
  const char* heads[] = {
      "A LAMP OF 1986: lines of text\nthat may hold anything, [BRACKETS] and what looks like TILT=NONE within\nTILT=NONE\n",
      "IESNA91\n[TEST] 1\n[TESTLAB] a laboratory\n[MANUFAC] somebody\n[MORE] and more of it\n[BLOCK]\n[LUMCAT] 2\n[ENDBLOCK]\n"
      "TILT=INCLUDE\n2\n2\n0 90\n1 0.94\n",
      "IESNA:LM-63-1995\n[TEST] 1\n[ISSUEDATE] 1-JAN-1996\n[_OWN] a keyword of its own\nTILT=lamp.tlt\n",
      "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] 1-JAN-2003\n[MANUFAC] y\n[NEARFIELD] 0.1 0.2 0\nTILT=NONE\n",
      "IES:LM-63-2019\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] 1-JAN-2020\n[MANUFAC] y\n[FILEGENINFO] z\nTILT=NONE\n"};
  for (const char* head : heads)
    for (const int type : {1, 2}) {
      Ies ies;
      ies.head = head;
      ies.type = type;
      ies.vertical = steps(type == 1 ? 0 : -90, 90, 15);
      ies.horizontal = type == 1 ? steps(0, 360, 45) : steps(-90, 90, 15);
      ies.candela = [](double v, double h) { return 200 + v + h / 4; };
      ies.ballast = std::string(head).find("2019") != std::string::npos ? "1 1.00001 30" : "1 1 30";
      const LightProfile profile = read(ies);
      ASSERT_EQ(profile.type, type == 1 ? LightProfile::Type::c : LightProfile::Type::b) << head;
      const Vec3d aside = type == 1 ? direction_c(30, 45) : direction_b(30, 45);
      EXPECT_NEAR(intensity(profile, aside), ies.candela(30, 45), 1e-4) << head << type;
      // A file with each number on its own line, or with tabs and commas between them, is the same file.
      std::string lines = ies.text(), commas = lines;
      const std::size_t numbers_begin = lines.rfind("2 0.1 0.2 0\n");
      for (std::size_t i = numbers_begin; i < lines.size(); ++i)
        if (lines[i] == ' ') lines[i] = '\n', commas[i] = i % 2 == 0 ? ',' : '\t';
      EXPECT_EQ(intensity(read(lines), aside), intensity(profile, aside)) << head;
      EXPECT_EQ(intensity(read(commas), aside), intensity(profile, aside)) << head;
    }
}

// Planes from 90 to 270, which the version of 1995 introduced, and halves of type C that begin below or above.
TEST(Ies, LampsThatShineUpOrDownAlone) {
  Ies up;
  up.vertical = steps(90, 180, 15);
  up.candela = [](double v, double) { return v; };
  EXPECT_NEAR(intensity(read(up), direction_c(135, 50)), 135, 1e-4);
  EXPECT_EQ(intensity(read(up), direction_c(45, 50)), 0);
  Ies turned;
  turned.horizontal = steps(90, 270, 30);
  turned.candela = [](double v, double h) { return 300 + v + (h - 180); };
  for (const double h : {100.0, 200.0, 260.0}) EXPECT_NEAR(intensity(read(turned), direction_c(20, h)), 320 + h - 180, 1e-3) << h;
  EXPECT_NEAR(intensity(read(turned), direction_c(20, 350)), intensity(read(turned), direction_c(20, 190)), 1e-6) << "its own mirror image";
}

TEST(Ies, FactorsMultiply) {
  Ies ies;
  ies.factors = "2 500 3";
  ies.ballast = "0.5 0.8 30";
  EXPECT_NEAR(intensity(read(ies), {0, 0, 1}), 150, 1e-4);  // since 2002 the third factor is ignored
  EXPECT_EQ(read(ies).rated_lumens, 1000);
  ies.head = "IESNA:LM-63-1995\nTILT=NONE\n";
  EXPECT_NEAR(intensity(read(ies), {0, 0, 1}), 120, 1e-4);
  ies.head = "IES:LM-63-2019\nTILT=NONE\n";
  ies.ballast = "1 1.11000 30";  // a code
  EXPECT_NEAR(intensity(read(ies), {0, 0, 1}), 300, 1e-4);
  ies.factors = "1 -1 1";  // absolute
  EXPECT_EQ(read(ies).rated_lumens, 0);
}

// ---- EULUMDAT ----------------------------------------------------------------------------------------------------

struct Ldt {
  int symmetry = 0;
  std::vector<double> planes = steps(0, 330, 30), angles = steps(0, 180, 15);
  std::string lumens = "1500", conversion = "1";
  Candela per_klm = oval;

  std::string text() const {
    const std::size_t n = planes.size();
    const std::size_t first = symmetry == 3 ? 3 * n / 4 : 0;
    const std::size_t count = symmetry == 0 ? n : symmetry == 1 ? 1 : symmetry == 4 ? n / 4 + 1 : n / 2 + 1;
    std::string text = "nobody\n1\n" + std::to_string(symmetry) + "\n" + std::to_string(n) + "\n30\n" + std::to_string(angles.size()) +
                       "\n15\nreport\nlamp\nnumber\nfile\ndate\n100\n100\n50\n90\n90\n0\n0\n0\n0\n100\n80\n" + conversion +
                       "\n0\n1\n1\nLED\n" + lumens + "\n3000 K\n80\n15\n";
    for (int i = 0; i < 10; ++i) text += "0.5\n";
    for (const double c : planes) text += std::to_string(c) + "\n";
    for (const double g : angles) text += std::to_string(g) + "\n";
    for (std::size_t i = first; i < first + count; ++i)
      for (const double g : angles) text += std::to_string(per_klm(g, planes[i % n])) + "\n";
    return text;
  }
};

TEST(Eulumdat, EverySymmetryIsRead) {
  for (int symmetry = 0; symmetry <= 4; ++symmetry) {
    Ldt ldt;
    ldt.symmetry = symmetry;
    // For each symmetry, a lamp that has this symmetry and no other.
    if (symmetry == 0) ldt.per_klm = [](double v, double h) { return oval(v, h) + h; };
    if (symmetry == 1) ldt.per_klm = [](double v, double) { return 100 + v; };
    if (symmetry == 2) ldt.per_klm = [](double v, double h) { return oval(v, h) + 30 + 30 * std::cos(h * kDegree); };
    if (symmetry == 3) ldt.per_klm = [](double v, double h) { return oval(v, h) + 30 + 30 * std::sin(h * kDegree); };
    const LightProfile profile = read(ldt.text(), "lamp.ldt");
    EXPECT_EQ(profile.rated_lumens, 1500);
    for (double v = 15; v < 180; v += 15)
      for (double h = 0; h < 360; h += 30)
        EXPECT_NEAR(intensity(profile, direction_c(v, h)), 1.5 * ldt.per_klm(v, h), 1e-3) << symmetry << " " << v << " " << h;
  }
}

TEST(Eulumdat, DecimalCommasAndTheConversion) {
  Ldt ldt;
  ldt.conversion = "0,5";
  ldt.lumens = "2000,0";
  EXPECT_NEAR(intensity(read(ldt.text(), "LAMP.LDT"), {0, 0, 1}), oval(0, 0), 1e-3);
}

// ---- What is refused ---------------------------------------------------------------------------------------------

void expect_refused(const std::string& text, const std::string& name, const std::string& place, const std::string& problem) {
  try {
    read(text, name);
    ADD_FAILURE() << "not refused: " << problem;
  } catch (const Error& e) {
    EXPECT_EQ(e.place(), place) << e.what();
    EXPECT_NE(e.problem().find(problem), std::string::npos) << e.what();
  }
}

TEST(Ies, BadFilesAreRefusedWithTheirLine) {
  const std::string head = "IESNA91\nTILT=NONE\n";
  const auto refused = [&](const std::string& text, int line, const std::string& problem) {
    expect_refused(text, "lamp.ies", "lamp.ies: line " + std::to_string(line), problem);
  };
  refused("", 1, "no line TILT=");
  refused("IESNA91\n1 2 3\n", 2, "no line TILT=");
  refused(head + "one", 3, "the number of lamps, found 'one'");
  refused(head + "1 1000 1 2 1 3 2 0 0 0", 3, "type A");
  refused(head + "1 1000 1 2 1 4 2 0 0 0", 3, "the type of photometry is 4");
  refused(head + "1 1000 1 2.5 1 1 2 0 0 0", 3, "not a whole number");
  refused(head + "1 1000 1 900 900 1 2 0 0 0\n1 1 30\n", 3, "is 900");  // more than the characters of the file
  refused(head + "1 1000 1 20 20 1 2 0 0 0\n1 1 30\n", 4, "more than the file holds");
  refused(head + "1 1000 1 2 1 1 2 0 0 0\n1 1 30\n90 0\n0\n1 1\n", 5, "0 follows 90");
  refused(head + "1 1000 1 2 1 1 2 0 0 0\n1 1 30\n0 190\n0\n1 1\n", 5, "is 190");
  refused(head + "1 1000 1 2 2 1 2 0 0 0\n1 1 30\n0 90\n20 50\n1 1\n1 1\n", 6, "horizontal angles");
  refused(head + "1 1000 1 2 2 1 2 0 0 0\n1 1 30\n0 90\n90 270\n1 1\n1 1\n", 6, "horizontal angles");  // without the plane of 180
  refused(head + "1 1000 1 2 1 2 2 0 0 0\n1 1 30\n0 90\n0\n1 1\n", 6, "type B has one horizontal angle");
  refused(head + "1 1000 1 2 1 1 2 0 0 0\n1 1 30\n0 90\n0\n1\n", 8, "the file ends where an intensity");
  refused(head + "1 1000 1 2 1 1 2 0 0 0\n1 1 30\n0 90\n0\n1 -1\n", 7, "is -1");
  refused(head + "1 1000 1 2 1 1 2 0 0 0\n1 1 30\n0 90\n0\n1 nan\n", 7, "expected an intensity, found 'nan'");
  refused(head + "1 1000 1 2 1 1 2 0 0 0\n1 1 30\n0 90\n0\n1 1\n5\n", 8, "more follows");
  refused(head + "1 1000 1e300 2 1 1 2 0 0 0", 3, "the multiplier");
  expect_refused(head + "1 1000 1e12 2 1 1 2 0 0 0\n1e12 1 30\n0 90\n0\n1 1\n", "lamp.ies", "lamp.ies: line 4", "more than 1e12");
}

TEST(Eulumdat, BadFilesAreRefusedWithTheirLine) {
  const auto refused = [](const std::string& text, int line, const std::string& problem) {
    expect_refused(text, "lamp.ldt", "lamp.ldt: line " + std::to_string(line), problem);
  };
  refused("", 1, "the file ends");
  refused("a\nb\n7\n", 3, "the symmetry (0 to 4) is 7, which is not from 0 to 4");
  refused("a\nb\nnone\n", 3, "expected the symmetry (0 to 4), found 'none'");
  refused("a\nb\n0\n1e9\n", 4, "C planes");
  Ldt ldt;
  ldt.symmetry = 4;
  ldt.planes = steps(0, 330, 33);
  EXPECT_THROW(read(ldt.text(), "lamp.ldt"), Error);
  const std::string whole = Ldt{}.text();
  EXPECT_NO_THROW(read(whole + "\nmade by nobody\n", "lamp.ldt"));
  try {
    read(whole + "\n12,5\n", "lamp.ldt");
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_NE(e.problem().find("more intensities follow than the symmetry"), std::string::npos) << e.what();
  }
  EXPECT_THROW(read(whole.substr(0, whole.size() - 20), "lamp.ldt"), Error);
}

TEST(LightProfile, LimitsAreKept) { EXPECT_THROW(read_light_profile_from_memory(Ies{}.text(), "lamp.ies", {.memory = 1000}), Error); }

// ---- In a scene --------------------------------------------------------------------------------------------------

// A white floor of 8 m, and a lamp 2 m above it that shines more along its x than along its y. The camera looks straight down.
LoadedScene lit_floor(const nlohmann::json& rotation) {
  Ies lamp;
  lamp.horizontal = steps(0, 90, 15);
  lamp.candela = [](double v, double h) { return 100 + 40 * std::cos(2 * h * kDegree) * std::sin(v * kDegree); };
  scene::GltfTestFile f;
  f.json["materials"] = {
      {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}, {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}}};
  const int positions = f.add_floats({-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4}, "VEC3"), indices = f.add_indices({0, 1, 2, 0, 2, 3});
  f.add_mesh({{"POSITION", positions}}, indices)["material"] = 0;
  f.json["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", "data:application/x-ies-lm-63;base64," + scene::base64(lamp.text())}}};
  f.append("nodes", {{"translation", {0, 2, 0}},
                     {"rotation", rotation},
                     {"extensions", {{"EXT_lights_ies", {{"light", 0}, {"multiplier", 2}, {"color", {1, 0.5, 0.25}}}}}}});
  f.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", std::numbers::pi / 2}, {"znear", 0.1}}}});
  const double s = std::sqrt(0.5);
  f.append("nodes", {{"translation", {0, 3, 0}}, {"rotation", {-s, 0, 0, s}}, {"camera", 0}});
  f.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  f.json["scene"] = 0;
  return load_scene(f.write("ies.gltf"));
}

// Turns -z straight down: a rotation about x by -90 degrees, after one about z by `turn`.
nlohmann::json downwards(double turn) {
  const double s = std::sqrt(0.5), c = std::cos(turn / 2), q = std::sin(turn / 2);
  return {-s * c, s * q, s * q, s * c};  // (-s, 0, 0, s) times (0, 0, q, c)
}

TEST(IesInAScene, LightsAFloorByItsIntensity) {
  for (const double turn : {0.0, 0.7}) {
    const LoadedScene loaded = lit_floor(downwards(turn));
    ASSERT_EQ(loaded.scene.punctual_lights.size(), 1u);
    const PunctualLight& light = loaded.scene.punctual_lights[0];
    ASSERT_NE(light.profile, nullptr);
    EXPECT_NEAR(light.direction.y, -1, 1e-12);
    EXPECT_NEAR(length(light.profile_axes.x - Vec3d{std::cos(turn), 0, -std::sin(turn)}), 0, 1e-12);
    RenderOptions options;
    options.width = options.height = 31;
    const Picture picture = render(loaded.scene, options);
    options.method = "sampled";  // a separate path to the light, in double
    const Picture judged = render(loaded.scene, options);
    double largest = 0;
    for (int y = 0; y < 31; ++y)
      for (int x = 0; x < 31; ++x) {
        const Vec3d p = {(x - 15) / 15.5 * 3, 0, (y - 15) / 15.5 * 3}, from = p - light.position;
        const double d2 = dot(from, from), cosine = 2 / std::sqrt(d2);
        const double v = std::acos(cosine), h = std::atan2(-p.z, p.x) - turn;
        const double candela = 2 * (100 + 40 * std::cos(2 * h) * std::sin(v)), want = candela * cosine / d2 / std::numbers::pi;
        // The profile is linear between planes 15 degrees apart. A chord of cos 2h is off by (0.26)^2 / 2 of 40, a chord of sin v by far
        // less.
        EXPECT_NEAR(static_cast<double>(picture.at(x, y).x), want, 0.03 * want) << x << " " << y;
        EXPECT_NEAR(picture.at(x, y).y, picture.at(x, y).x / 2, 1e-5);
        EXPECT_NEAR(picture.at(x, y).x, judged.at(x, y).x, 2e-5f * judged.at(x, y).x);
        largest = std::max(largest, want);
      }
    EXPECT_GT(largest, 10);
  }
}

TEST(IesInAScene, ABadProfileIsRefusedByItsPlace) {
  scene::GltfTestFile f;
  f.add_mesh({{"POSITION", f.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}});
  f.json["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", "data:;base64," + scene::base64("IESNA91\nTILT=NONE\nnothing\n")}}};
  f.append("nodes", {{"extensions", {{"EXT_lights_ies", {{"light", 0}}}}}});
  f.json["scenes"] = {{{"nodes", {0, 1}}}};
  try {
    load_scene(f.write("bad_ies.gltf"));
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(e.place().find("EXT_lights_ies.lights[0]: line 3"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace steradian::photometry_test
