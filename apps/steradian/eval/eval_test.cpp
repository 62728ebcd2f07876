#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>

#include "eval/answer.h"
#include "steradian/polygon_light.h"

namespace steradian::eval::eval_test {
namespace {

using nlohmann::json;

const std::string kLight = R"("light":{"type":"rect","center":[0,2,0],"x":[1,0,0],"y":[0,0,1]})";
const std::string kPlace = R"("position":[0,0,0],"normal":[0,1,0],"view":[0,1,0.5])";
const std::string kLambert = R"("material":{"brdf":"lambert"})";

std::string query(const std::string& light, const std::string& place, const std::string& material, const std::string& rest = {}) {
  return "{" + light + "," + place + "," + material + (rest.empty() ? "" : "," + rest) + "}";
}
std::string with_material(const std::string& material, const std::string& rest = {}) {
  return query(kLight, kPlace, "\"material\":" + material, rest);
}
std::string with_light(const std::string& light) { return query("\"light\":" + light, kPlace, kLambert); }

std::string answer_text(std::string line) {
  static QueryReader reader;
  const std::size_t size = line.size();
  line.append(kQueryPadding, ' ');
  std::string out;
  answer_line(reader, {line.data(), size}, out);
  return out;
}
json answer(const std::string& line) { return json::parse(answer_text(line)); }

double red(const std::string& line) {
  const json a = answer(line);
  if (!a.contains("radiance")) {
    ADD_FAILURE() << line << "\n" << a;
    return -1;
  }
  return a["radiance"][0].get<double>();
}

// ---- What is right ---------------------------------------------------------------------------------------------

TEST(Eval, LambertUnderACentredSquareIsTheTabulatedConfigurationFactor) {
  // Four times the factor of a rectangle under its corner (Howell, C-11): a = b = 1, c = 2.
  const double x = 0.5, s = std::sqrt(1 + x * x);
  const double corner = x / s * std::atan(x / s) / M_PI;
  EXPECT_NEAR(red(query(kLight, kPlace, kLambert)), 4 * corner, 1e-14);
}

TEST(Eval, AnswersEveryMaterialMethodAndLight) {
  const std::string materials[] = {R"({"brdf":"lambert","albedo":[0.2,0.5,0.8]})",
                                   R"({"brdf":"phong","exponent":20,"albedo":0.5})",
                                   R"({"brdf":"ggx","roughness":0.5,"f0":0.04,"f90":[1,0.9,0.8]})",
                                   R"({"brdf":"ggx","alpha":0.3,"shadowing":"none"})",
                                   R"({"brdf":"ggx","alpha_x":0.2,"alpha_y":0.4,"tangent":[1,0,1]})",
                                   R"({"brdf":"blinn-phong","exponent":10})",
                                   R"({"brdf":"beckmann","alpha":0.3})"};
  const std::string lights[] = {kLight, R"("light":{"type":"point","position":[1,2,0],"intensity":[3,2,1]})",
                                R"("light":{"type":"polygon","vertices":[[-1,2,1],[-1,2,-1],[1,2,-1],[1,2,1]],)"
                                R"("holes":[[[0,2,0],[0.5,2,0],[0,2,0.5]]],"radiance":[1,2,3],"two_sided":true})"};
  for (const std::string& light : lights)
    for (const std::string& material : materials) {
      json truth;
      for (const std::string method : {"reference", "auto", "sampled"}) {
        const std::string line =
            query(light, kPlace, "\"material\":" + material, R"("method":")" + method + R"(","spp":16,"seed":3,"precision":"double")");
        const json a = answer(line);
        ASSERT_TRUE(a.contains("radiance")) << line << "\n" << a;
        const auto is = [&](const char* part) { return material.find(part) != std::string::npos; };
        const std::string resolved = is("lambert") || is("none") ? "exact"
                                     : is("\"phong")             ? "series"
                                     : is("ggx")                 ? "closed-form"
                                                                 : "half-vector";
        EXPECT_EQ(a["method"], method != "auto" ? method : resolved);
        EXPECT_EQ(a.contains("standard_error"), method == "sampled");
        EXPECT_EQ(a.contains("bound"), a["method"] == "reference");
        if (method == "reference") truth = a;
        // Errors from docs/measured/accuracy.md, as fractions of the full lobe: the largest errors of single points, under lights of
        // radiance 3 at most. For `sampled` its standard error.
        const double of_method = resolved == "exact" ? 1e-9 : resolved == "series" ? 1.3e-3 : resolved == "closed-form" ? 0.02 : 0.03;
        const bool is_point = light.find("point") != std::string::npos;
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = a["radiance"][c], right = truth["radiance"][c], bound = truth.value("bound", 0.0);
          const double allowed = is_point ? 0 : method == "sampled" ? 5 * a["standard_error"].get<double>() : 3 * of_method;
          EXPECT_NEAR(value, right, bound + allowed + 1e-12 * right) << line << "\n" << truth;
        }
      }
    }
}

TEST(Eval, PhongMethodsAgreeWithTheReference) {
  const std::string phong = R"("material":{"brdf":"phong","exponent":20,"albedo":0.5})";
  const json reference = answer(query(kLight, kPlace, phong, R"("method":"reference")"));
  const double truth = reference["radiance"][0];
  struct Bound {
    const char* method;
    double of_full_lobe;  // docs/theory/moments.md
  };
  for (const Bound& b : {Bound{"exact", 1e-10}, Bound{"arvo", 1e-10}, Bound{"series", 1.3e-3}, Bound{"lorentzian", 0.1},
                         Bound{"pearson", 0.1}, Bound{"ellipsoid", 0.1}})
    for (const char* precision : {"double", "float"}) {
      const std::string rest = std::string(R"("method":")") + b.method + R"(","precision":")" + precision + '"';
      const double in_float = *precision == 'f' ? 1e-6 : 0;  // a few roundings of directions and sums
      EXPECT_NEAR(red(query(kLight, kPlace, phong, rest)), truth, 0.5 * b.of_full_lobe + in_float) << rest;
    }
  const double normal = red(query(kLight, kPlace, phong)), high = red(query(kLight, kPlace, phong, R"("quality":"high")"));
  EXPECT_NE(normal, high);
  EXPECT_NEAR(high, truth, 0.5 * 4.5e-4);
}

TEST(Eval, MicrofacetMethodsAgreeWithTheReference) {
  struct Bound {
    const char* material;
    const char* method;
    double error;  // docs/measured/accuracy.md, "GGX with shadowing and Fresnel" and "Half vectors": the largest rms is far below
  };
  for (const Bound& b : {Bound{R"({"brdf":"ggx","roughness":0.5,"f0":[1,0.04,0.5]})", R"("method":"closed-form")", 0.005},
                         Bound{R"({"brdf":"ggx","roughness":0.5})", R"("method":"closed-form","quality":"high")", 0.002},
                         Bound{R"({"brdf":"ggx","roughness":0.5})", R"("method":"closed-form","quality":"draft")", 0.05},
                         Bound{R"({"brdf":"ggx","alpha":0.3,"shadowing":"none"})", R"("method":"exact")", 1e-6},
                         Bound{R"({"brdf":"ggx","alpha":0.3,"shadowing":"none"})", R"("method":"half-vector")", 0.01},
                         Bound{R"({"brdf":"blinn-phong","exponent":20})", R"("method":"half-vector")", 0.01},
                         Bound{R"({"brdf":"beckmann","alpha":0.3})", R"("method":"half-vector","quality":"high")", 0.003}}) {
    const std::string material = std::string(R"("material":)") + b.material;
    const double truth = red(query(kLight, kPlace, material, R"("method":"reference")"));
    for (const char* precision : {R"("precision":"double")", R"("precision":"float")"}) {
      const double value = red(query(kLight, kPlace, material, std::string(b.method) + "," + precision));
      EXPECT_NEAR(value, truth, b.error) << material << b.method << precision;
      EXPECT_GT(truth, 0.01);
    }
  }
}

TEST(Eval, AgreesWithTheReferenceOnLambert) {
  const std::string line = query(kLight, kPlace, kLambert);
  const json reference = answer(query(kLight, kPlace, kLambert, R"("method":"reference")"));
  EXPECT_NEAR(red(line), reference["radiance"][0].get<double>(), reference["bound"].get<double>() + 1e-15);
}

TEST(Eval, VectorsNeedNotBeUnit) {
  const std::string ggx = R"("material":{"brdf":"ggx","roughness":0.5})";
  EXPECT_DOUBLE_EQ(red(query(kLight, kPlace, ggx)), red(query(kLight, R"("position":[0,0,0],"normal":[0,7,0],"view":[0,1e-3,5e-4])", ggx)));
}

TEST(Eval, MaterialsOfAListAdd) {
  const std::string a = R"({"brdf":"lambert","albedo":0.3})", b = R"({"brdf":"beckmann","alpha":0.3})";
  const json both = answer(with_material("[" + a + "," + b + "]"));
  EXPECT_DOUBLE_EQ(both["radiance"][0].get<double>(), red(with_material(a)) + red(with_material(b)));
  EXPECT_EQ(both["method"], "exact+half-vector");
  EXPECT_TRUE(answer(with_material("[" + a + "," + b + "]", R"("method":"reference")")).contains("bound"));
  EXPECT_EQ(answer(with_material("[" + a + "," + a + "]"))["method"], "exact");
}

TEST(Eval, FloatIsFloat) {
  const json d = answer(query(kLight, kPlace, kLambert));
  const json f = answer(query(kLight, kPlace, kLambert, R"("precision":"float")"));
  const double x = d["radiance"][0], y = f["radiance"][0];
  EXPECT_NE(x, y);
  // A quad: four edges of a few ulp each, sums within pi.
  EXPECT_NEAR(x, y, 64 * 0x1p-24);
  // The shortest decimal of a float has at most 9 digits.
  EXPECT_LE(f["radiance"][0].dump().size(), 12u) << f;
}

TEST(Eval, DegenerateGeometryAndHiddenSidesGiveZeroAndNeverMinusZero) {
  const std::string zero = "{\"radiance\":[0,0,0],\"method\":\"exact\"}\n";
  EXPECT_EQ(answer_text(with_light(R"({"type":"polygon","vertices":[[0,1,0],[1,1,0],[2,1,0]]})")), zero);
  EXPECT_EQ(answer_text(with_light(R"({"type":"polygon","vertices":[[0,1,0],[0,1,0],[0,1,0]]})")), zero);
  EXPECT_EQ(answer_text(with_light(R"({"type":"rect","center":[0,2,0],"x":[0,0,0],"y":[0,0,1]})")), zero);
  EXPECT_EQ(answer_text(with_light(R"({"type":"rect","center":[0,2,0],"x":[1,0,0],"y":[0,0,-1]})")), zero);
  EXPECT_EQ(answer_text(with_light(R"({"type":"point","position":[0,-1,0],"intensity":1})")), zero);
  EXPECT_EQ(answer_text(with_light(R"({"type":"point","position":[0,0,0],"intensity":1})")), zero);
  const std::string below = R"("position":[0,0,0],"normal":[0,1,0],"view":[1,-0.1,0])";
  EXPECT_EQ(answer_text(query(kLight, below, kLambert)), zero);
  EXPECT_EQ(red(query(kLight, below, R"("material":{"brdf":"ggx","roughness":0.5})")), 0);
  Answer minus;
  minus.radiance = {-0.0, 0.0, -0.0};
  minus.method = "exact";
  std::string out;
  write_answer(out, minus);
  EXPECT_EQ(out, zero);
}

TEST(Eval, APointLightFollowsTheInverseSquareAndTheLobe) {
  // Lambert, 60 degrees off the normal at distance 2: I cos / (pi d^2).
  const double expected = 5 * 0.5 / (M_PI * 4);
  EXPECT_NEAR(red(with_light(R"({"type":"point","position":[1.7320508075688772,1,0],"intensity":5})")), expected, 1e-15);
}

TEST(Eval, NumbersReadBackTheSame) {
  Answer a;
  a.method = "exact";
  std::mt19937_64 random(7);
  for (int i = 0; i < 1000; ++i) {
    a.radiance.x = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 600) - 300);
    std::string out;
    write_answer(out, a);
    EXPECT_EQ(std::strtod(out.c_str() + out.find('[') + 1, nullptr), a.radiance.x) << out;
  }
}

// ---- What is wrong ---------------------------------------------------------------------------------------------

struct Wrong {
  std::string line;
  std::vector<const char*> says;  // the message contains all of these
};

TEST(Eval, NamesTheKeyOfEveryKindOfWrongInput) {
  const std::string good = query(kLight, kPlace, kLambert);
  const auto polygon = [](const std::string& vertices) { return with_light(R"({"type":"polygon","vertices":)" + vertices + "}"); };
  const std::vector<Wrong> all = {
      {"hello", {"not JSON"}},
      {"{", {"not JSON"}},
      {good + "}", {"not JSON"}},
      {std::string("{\"a\0\":1}", 8), {"not JSON"}},
      {"{\"\xff\":1}", {"not JSON"}},
      {"[]", {"expected an object", "a list"}},
      {"3", {"expected an object", "a number"}},
      {"{}", {"light: missing", "position: missing", "normal: missing", "material: missing"}},
      {query(kLight, R"("position":[NaN,0,0],"normal":[0,1,0])", kLambert), {"not JSON"}},
      {query(kLight, R"("position":[0,Infinity,0],"normal":[0,1,0])", kLambert), {"not JSON"}},
      {query(kLight, R"("position":[1e999,0,0],"normal":[0,1,0])", kLambert), {"not JSON"}},
      {query(kLight, R"("normal":[0,1,0])", kLambert), {"position: missing"}},
      {query(kLight, R"("position":"here","normal":[0,1,0])", kLambert), {"position: expected a list", "a string"}},
      {query(kLight, R"("position":[0,0],"normal":[0,1,0])", kLambert), {"position: expected 3", "found 2"}},
      {query(kLight, R"("position":[0,null,0],"normal":[0,1,0])", kLambert), {"position[1]: expected a number"}},
      {query(kLight, R"("position":[0,0,0],"normal":[0,0,0])", kLambert), {"normal: the vector is zero"}},
      {query(kLight, R"("position":[0,0,0],"normal":[0,1,0],"view":[0,0,0])", kLambert), {"view: the vector"}},
      {query(kLight, R"("position":[0,0,0],"normal":[0,1,0])", R"("material":{"brdf":"phong","exponent":3})"), {"view: missing", "phong"}},
      {query(kLight, kPlace, kLambert, R"("method":"magic")"), {"method: 'magic'", "sampled"}},
      {query(kLight, kPlace, kLambert, R"("method":3)"), {"method: expected a string"}},
      {query(kLight, kPlace, kLambert, R"("precision":"half")"), {"precision: 'half'"}},
      {query(kLight, kPlace, kLambert, R"("precision":"float","method":"reference")"), {"precision: ", "reference"}},
      {query(kLight, kPlace, kLambert, R"("spp":0)"), {"spp: must be"}},
      {query(kLight, kPlace, kLambert, R"("spp":1.5)"), {"spp: expected an integer"}},
      {query(kLight, kPlace, kLambert, R"("seed":-1)"), {"seed: must be"}},
      {with_material(R"({"brdf":"ggx","roughness":0.5})", R"("derivatives":true,"method":"ltc-clipless")"),
       {"derivatives: ", "ggx has none"}},
      {query(kLight, kPlace, kLambert, R"("normal":[0,0,1])"), {"normal: the key is given twice"}},
      {query(kLight, kPlace, kLambert, R"("colour":1,"size":2)"), {"colour: unknown", "size: unknown"}},
      {query(R"("light":{"type":"rect","centre":[0,2,0],"x":[1,0,0],"y":[0,0,1]})", kPlace, R"("material":{"brdf":"lambert","exponent":2})",
             R"("extra":{})"),
       {"light.centre: unknown", "light.center: missing", "material.exponent: unknown", "extra: unknown"}},
      {with_light("7"), {"light: expected an object"}},
      {with_light("{}"), {"light.type: missing", "polygon, rect, disk, sphere, ellipsoid, capsule, point"}},
      {with_light(R"({"type":"tube"})"), {"light.type: 'tube' is not supported", "polygon, rect, disk, sphere, ellipsoid, capsule, point"}},
      {with_light(R"({"type":"disk"})"), {"light.center: missing", "light.x: missing", "light.y: missing"}},
      {with_light(R"({"type":"sphere","center":[0,1,0],"radius":-1})"), {"light.radius: must not be negative"}},
      {with_light(R"({"type":"sphere","center":[0,1,0],"radius":1,"two_sided":true})"), {"light.two_sided: unknown"}},
      {with_light(R"({"type":"ellipsoid","center":[0,1,0],"x":[1,0,0],"y":[0,1,0]})"), {"light.z: missing"}},
      {query(R"("light":{"type":"disk","center":[1e308,2,0],"x":[1,0,0],"y":[0,0,1]})", R"("position":[-1e308,0,0],"normal":[0,1,0])",
             kLambert),
       {"light: is not finite"}},
      {with_light(R"({"type":["rect"]})"), {"light.type: expected a string"}},
      {polygon("[[0,1,0],[1,1,0]]"), {"light.vertices: ", "at least 3 vertices", "2"}},
      {polygon("[]"), {"light.vertices: ", "at least 3 vertices"}},
      {polygon("[[0,1,0],[1,1,0],[1,1,\"z\"]]"), {"light.vertices[2][2]: expected a number"}},
      {polygon("[[0,1,0],[1,1,0],[1,1,1],[0,2,1]]"), {"light.vertices[", "off the polygon's plane"}},
      {with_light(R"({"type":"polygon","vertices":[[0,1,0],[1,1,0],[1,1,1]],"holes":[[[0,1,0]]]})"), {"light.holes[0]: ", "at least 3"}},
      {with_light(R"({"type":"polygon","vertices":[[0,1,0],[1,1,0],[1,1,1]],"two_sided":1})"), {"light.two_sided: expected true or false"}},
      {with_light(R"({"type":"polygon","vertices":[[0,1,0],[1,1,0],[1,1,1]],"radiance":-1})"), {"light.radiance: must not be negative"}},
      {with_light(R"({"type":"polygon","vertices":[[0,1,0],[1,1,0],[1,1,1]],"radiance":[1,2]})"), {"light.radiance: expected 3 numbers"}},
      {with_light(R"({"type":"rect","center":[1e308,2,0],"x":[1e308,0,0],"y":[0,0,1]})"), {"light", "finite"}},
      {query(R"("light":{"type":"point","position":[0,1,0],"intensity":1e308})", kPlace, R"("material":{"brdf":"lambert","albedo":1e300})"),
       {"radiance: ", "out of the range"}},
      {with_material("[]"), {"material: the list is empty"}},
      {with_material(R"([{"brdf":"lambert"},{"brdf":"velvet"}])"), {"material[1].brdf: 'velvet'", "beckmann"}},
      {with_material(R"({"albedo":1})"), {"material.brdf: missing"}},
      {with_material(R"({"brdf":"phong"})"), {"material.exponent: missing"}},
      {with_material(R"({"brdf":"ggx"})"), {"material.alpha: missing", "roughness"}},
      {with_material(R"({"brdf":"ggx","roughness":2})"), {"material.roughness: must be from 0 to 1"}},
      {with_material(R"({"brdf":"ggx","roughness":0.5,"alpha":0.5})"), {"material.alpha: ", "twice"}},
      {with_material(R"({"brdf":"ggx","alpha_x":0.5})"), {"material.alpha_y: missing"}},
      {with_material(R"({"brdf":"ggx","alpha":0.5,"shadowing":"some"})"), {"material.shadowing: 'some'"}},
      {with_material(R"({"brdf":"beckmann","alpha":0.3})", R"("method":"exact")"), {"method: exact", "beckmann"}},
      {with_material(R"({"brdf":"phong","exponent":3.5})", R"("method":"arvo")"), {"method: arvo", "phong", "series"}},
      {query(kLight, kPlace, kLambert, R"("method":"series")"), {"method: series", "lambert", "exact"}},
      {query(kLight, kPlace, kLambert, R"("quality":"best")"), {"quality: 'best'", "normal or high"}},
  };
  for (const Wrong& wrong : all) {
    const json a = answer(wrong.line);
    ASSERT_TRUE(a.contains("error")) << wrong.line << "\n" << a;
    for (const char* text : wrong.says)
      EXPECT_NE(a["error"].get<std::string>().find(text), std::string::npos) << wrong.line << "\n" << a << "\n" << text;
  }
}

// A result that only fits into a double is an error in float, not "inf".
TEST(Eval, AResultBeyondTheRangeOfFloatIsRefusedInFloat) {
  const std::string lights[] = {R"("light":{"type":"point","position":[0,1,0],"intensity":1e300})",
                                R"("light":{"type":"point","position":[0,1e-25,0],"intensity":1})",
                                R"("light":{"type":"rect","center":[0,2,0],"x":[1,0,0],"y":[0,0,1],"radiance":1e41})",
                                R"("light":{"type":"disk","center":[0,2,0],"x":[1,0,0],"y":[0,0,1],"radiance":1e41})",
                                R"("light":{"type":"capsule","ends":[[0,2,0],[1,2,0]],"radius":0.1,"radiance":1e41})"};
  for (const std::string& light : lights) {
    const std::string text = answer_text(query(light, kPlace, kLambert, R"("precision":"float")"));
    EXPECT_EQ(text.find("inf"), std::string::npos) << text;
    EXPECT_NE(text.find("error"), std::string::npos) << text;
  }
}

TEST(Eval, MessagesAreJsonWhateverTheKeyIs) {
  const std::string odd = R"("a\"\\\n\u0001\u00e9)" + std::string(200, 'k') + R"(":1)";
  const json a = answer(query(kLight, kPlace, kLambert, odd));
  EXPECT_NE(a["error"].get<std::string>().find("unknown key"), std::string::npos);
  EXPECT_LT(a["error"].get<std::string>().size(), 500u);
}

// The answer to any line is one line of JSON: a finite radiance or an error.
TEST(Eval, SurvivesMutatedLines) {
  const std::string seeds[] = {
      query(kLight, kPlace, kLambert, R"("method":"exact","precision":"float")"),
      query(R"("light":{"type":"polygon","vertices":[[-1,2,1],[-1,2,-1],[1,2,-1],[1,2,1]],)"
            R"("holes":[[[0,2,0],[0.5,2,0],[0,2,0.5]]],"radiance":[1,2,3],"two_sided":true})",
            kPlace, R"("material":[{"brdf":"lambert","albedo":[0.1,0.2,0.3]},{"brdf":"lambert"}])"),
      query(R"("light":{"type":"point","position":[1,2,0],"intensity":1e3})", kPlace,
            R"("material":{"brdf":"ggx","alpha_x":0.2,"alpha_y":0.4,"tangent":[1,0,1],"f0":0.04})"),
      query(R"("light":{"type":"ellipsoid","center":[1,2,0],"x":[0.5,0,0],"y":[0,0.1,0],"z":[0,1,1]})", kPlace,
            R"("material":[{"brdf":"lambert"},{"brdf":"phong","exponent":20}])"),
      query(R"("light":{"type":"disk","center":[1,2,0],"x":[0.5,0,0],"y":[0,0.1,0.5],"two_sided":true})", kPlace,
            R"("material":{"brdf":"ggx","roughness":0.5})"),
  };
  std::mt19937 random(20260101);
  const auto below = [&](std::size_t n) { return random() % n; };
  const std::string bytes = "0123456789.eE+-[]{}\",:\\ntrfux \t";
  int answered = 0, refused = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string line = seeds[static_cast<std::size_t>(i) % std::size(seeds)];
    const std::size_t edits = 1 + below(3);
    for (std::size_t e = 0; e < edits; ++e) {
      const std::size_t at = below(line.size());
      switch (below(8)) {
        case 0: line[at] = static_cast<char>(below(256)); break;
        case 1: line[at] = bytes[below(bytes.size())]; break;
        case 2: line.erase(at, 1 + below(4)); break;
        case 3: line.insert(at, 1, bytes[below(bytes.size())]); break;
        case 4: line.insert(at, line.substr(below(line.size()), below(12))); break;
        default: {  // another digit: the line stays JSON
          const std::size_t digit = line.find_first_of("0123456789", at);
          if (digit != std::string::npos) line[digit] = static_cast<char>('0' + below(10));
        }
      }
    }
    const std::string text = answer_text(line);
    const json a = json::parse(text, nullptr, false);
    ASSERT_FALSE(a.is_discarded()) << line << "\n" << text;
    ASSERT_EQ(text.find('\n'), text.size() - 1);
    if (a.contains("error")) {
      ++refused;
    } else {
      ++answered;
      for (const json& x : a["radiance"]) ASSERT_TRUE(std::isfinite(x.get<double>()) && x >= 0) << line << text;
    }
  }
  EXPECT_GT(answered, 100);
  EXPECT_GT(refused, 1000);
}

// Compares the derivatives of [channel][vertex] with the same query after moving a vertex.
TEST(Eval, DerivativesByVerticesAgreeWithMovedVertices) {
  const auto ask = [](double dx, const std::string& rest, double px = 0.2) {
    json light = {{"type", "polygon"}, {"radiance", {2, 1, 0.5}}, {"vertices", {{-1 + dx, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}}}};
    json position = {px, 0.1, 0};
    return answer(query("\"light\":" + light.dump(), "\"position\":" + position.dump() + R"(,"normal":[0,0.6,0.8])",
                        R"("material":{"brdf":"lambert","albedo":0.5})", rest));
  };
  const json got = ask(0, R"("derivatives":true)");
  ASSERT_EQ(got.at("d_vertices").size(), 3u) << got;
  ASSERT_EQ(got["d_vertices"][0].size(), 4u) << got;
  const double h = 1e-6;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double above = ask(h, {})["radiance"][channel], below = ask(-h, {})["radiance"][channel];
    // Truncation error h^2 times a third derivative of order 1, rounding error 1e-16 / h.
    EXPECT_NEAR(got["d_vertices"][channel][0][0].get<double>(), (above - below) / (2 * h), 1e-9) << got;
    const double right = ask(0, {}, 0.2 + h)["radiance"][channel], left = ask(0, {}, 0.2 - h)["radiance"][channel];
    EXPECT_NEAR(got.at("d_position")[channel][0].get<double>(), (right - left) / (2 * h), 1e-9) << got;
  }
  EXPECT_FALSE(ask(0, R"("derivatives":false)").contains("d_vertices"));
}

TEST(Eval, DerivativesOfTransformedCosinesAreServed) {
  for (const char* method : {"ltc", "ltc-compact"}) {
    const json a =
        answer(with_material(R"({"brdf":"ggx","roughness":0.6})", std::string(R"("derivatives":true,"method":")") + method + '"'));
    ASSERT_TRUE(a.contains("d_vertices")) << a;
    EXPECT_NE(a["d_vertices"][0][0][0].get<double>(), 0.0) << a;
    EXPECT_EQ(a.at("d_normal").size(), 3u) << a;
    EXPECT_NEAR(a["d_normal"][0][1].get<double>(), 0.0, 1e-15) << a;  // perpendicular to the normal
  }
}

// The library's test compares the derivatives with differences. This test checks that they are written, and that they add up over
// materials.
TEST(Eval, DerivativesOfPhongAndGgxAddUp) {
  const auto ask = [](const std::string& material) { return answer(with_material(material, R"("derivatives":true)")); };
  const std::string phong = R"({"brdf":"phong","exponent":8})", ggx = R"({"brdf":"ggx","roughness":0.6})";
  const json one = ask(phong), other = ask(ggx), both = ask("[" + phong + "," + ggx + "]");
  for (const json& a : {one, other, both}) ASSERT_TRUE(a.contains("d_vertices")) << a;
  const auto first = [](const json& a) { return a["d_vertices"][0][0][0].get<double>(); };
  EXPECT_NE(first(one), 0.0) << one;
  EXPECT_NE(first(other), 0.0) << other;
  EXPECT_NEAR(first(both), first(one) + first(other), 1e-15) << both;
}

TEST(Eval, DerivativesAreRefusedWhereThereAreNone) {
  EXPECT_TRUE(
      answer(with_material(R"({"brdf":"ggx","roughness":0.5})", R"("derivatives":true,"method":"ltc-clipless")")).contains("error"));
  EXPECT_TRUE(answer(query(R"("lights":[{"type":"point","position":[0,1,0]},{"type":"point","position":[0,2,0]}])", kPlace, kLambert,
                           R"("derivatives":true)"))
                  .contains("error"));
}

}  // namespace
}  // namespace steradian::eval::eval_test
