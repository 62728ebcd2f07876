// The page of the study of CIE 171.
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "bench/studies/cie171.h"

namespace steradian::cie171 {
namespace {

const char* const kHead = R"(# Test cases of CIE 171, measured

    steradian bench --cie171

CIE 171:2006 has test cases for lighting programs. This command computes the kinds of cases of its section 5 that view factors, moments
and all light answer, and prints this page. Sizes and points are this project's, not the standard's. Only the formula of case 5.8 is the
standard's. Its tables are not compared.

- "Exact" is a closed form or quadrature. It shares no code with the library.
- "Ours" is the library's answer, by the calls of the commands that are named.
- "Difference" is relative. `< 1e-12` names a derived bound (of `render`, its own estimate), and the difference is below it.
- The test `Cie171.EveryDifferenceIsWithinItsBound` prints the largest difference.

)";

const char* const kDiffuse = R"(## 5.6: light from a diffuse surface

A horizontal surface S2 sends diffuse light to a wall and to a ceiling. The values are configuration factors of points, and view factors
of whole surfaces. The wall stands on an edge of S2 and is 3 m high. The ceiling is 3 m above S2. The points lie across from the middle of
the edge, at a height (wall) or at a distance from the wall (ceiling).

)";

const char* const kObstructed = R"(## 5.7: with an obstruction inside

The same with S2 of 4 x 4 m and an obstruction. The screen stands parallel to the wall at 1 m and is 4 m wide. The plate covers a quarter of
the plane between S2 and the ceiling. What it hides is a rectangle of S2, so that factors of rectangles add up to the exact value.

Table 19 of the standard is known to be wrong (the published errata of Lighting Analysts). Therefore nothing here is compared with it.

)";

const char* const kRoom = R"(## 5.8: a closed room

A lamp of 10,000 lm in the middle of a room of 4 x 4 x 4 m shines alike in all directions. All sides have one reflectance rho. The mean
indirect illuminance is flux x rho / (area x (1 - rho)): the formula of the standard. It is exact as a mean.

By `viewfactor`, elements of 1 x 1 m exchange their light. By `render`, the mean is of a picture of one side at 64 x 64 pixels. Its
difference is within what the picture's layers `bounce_error` and `bounce_bound` say: an estimate.

)";

const char* const kSky = R"(## 5.9 to 5.14: the sky through openings without glass

The room is 4 x 4 x 3 m, and its surfaces are black. The points lie on the floor and face up. Two values are given:

- the configuration factor of the sky, which is the sky component under a uniform sky. The room and the masks are obstacles.
- with "overcast", the sky component under the overcast sky of the CIE, (1 + 2 sin)/3. The moments of the visible part of the opening give
  it (`double_axis_moment`). The study cuts this part itself.

| case | opening | outside |
|---|---|---|
| 5.9 | roof, in its middle or all of it | nothing |
| 5.11 | facade, 2 x 1 m with its sill at 1 m, or all of it | nothing |
| 5.13 | facade, 2 x 1 m | a long overhang of 1 m at 2.5 m |
| 5.14 | facade, 2 x 1 m | a long wall 6 m away, 5 m high |

A point of the facade's cases lies across from the middle of the opening, at a distance from the facade. The rows of a mask have its
configuration factor: times its radiance over that of the sky, this is the externally reflected component.

)";

void add_table(std::string& page, const std::vector<Comparison>& comparisons, std::initializer_list<const char*> numbers) {
  page += "| case | geometry | by | exact | ours | difference |\n|---|---|---|--:|--:|--:|\n";
  for (const Comparison& c : comparisons) {
    if (std::find(numbers.begin(), numbers.end(), c.number) == numbers.end()) continue;
    page += fmt::format("| {} | {} | {} | {:.10g}{} | {:.{}g}{} | {} {:.1e} |\n", c.number, c.geometry, c.way, c.exact, c.unit, c.ours,
                        c.is_estimate ? 4 : 10, c.unit, c.difference() <= c.bound ? "<" : "above", c.bound);
  }
  page += "\n";
}

const char* const kFoot = R"(## Links

- [View factors](../viewfactor.md), [their theory](../theory/view_factors.md), [how the tests judge](../testing.md).
)";

}  // namespace

std::string cie171_page(const std::vector<Comparison>& comparisons) {
  std::string page = kHead;
  const auto section = [&](const char* text, std::initializer_list<const char*> numbers) {
    page += text;
    add_table(page, comparisons, numbers);
  };
  section(kDiffuse, {"5.6"});
  section(kObstructed, {"5.7"});
  section(kRoom, {"5.8"});
  section(kSky, {"5.9", "5.11", "5.13", "5.14"});
  return page + kFoot;
}

}  // namespace steradian::cie171
