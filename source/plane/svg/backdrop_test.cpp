#include "plane/svg/backdrop.h"

#include <gtest/gtest.h>

#include <string>

#include "steradian/error.h"
#include "steradian/plane_animation.h"

namespace steradian::plane::backdrop_test {
namespace {

std::string svg_of(const std::string& inside) {
  return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 80'>\n" + inside + "\n</svg>";
}

PlaneSvg load(const std::string& inside) { return load_plane_scene_from_text(svg_of(inside), "test.svg"); }

std::string reasons(const PlaneSvg& svg) {
  std::string text;
  for (const PlaneLeftOut& shapes : svg.left_out) {
    for (const std::string& name : shapes.names) text += name + " ";
    text += std::string(words_of(shapes.why)) + "; ";
  }
  return text;
}

const std::string kLamps = "<g class='light' fill='#fff'><circle cx='20' cy='30' r='4'/><rect x='60' y='40' width='8' height='5'/></g>";

}  // namespace

TEST(Backdrop, IsWhatCoversThePicture) {
  const PlaneSvg svg = load("<rect id='page' width='100' height='80' fill='#eee'/><rect x='40' y='10' width='5' height='9'/>" + kLamps);
  ASSERT_EQ(svg.scene.bodies.size(), 3u);
  EXPECT_EQ(reasons(svg), "page covers the whole picture; ");
  EXPECT_GT(PlaneWorld(svg.scene).query({80, 20}).radiance.x, 0.01);
  for (const std::string cover :
       {"<circle cx='50' cy='40' r='70'/>", "<path d='M-9 -9H200V200H-9Z'/>", "<rect x='0.05' y='0.05' width='99.9' height='79.9'/>",
        "<g transform='rotate(90)'><rect y='-100' width='80' height='100'/></g>",
        "<use href='#p'/><defs><rect id='p' width='100%' height='100%'/></defs>"})
    EXPECT_EQ(load(cover + "<circle class='light' cx='150' cy='9' r='2' fill='#fff'/>").scene.bodies.size(), 1u) << cover;
}

TEST(Backdrop, IsWhatHoldsEveryLight) {
  const PlaneSvg svg = load("<ellipse cx='45' cy='38' rx='40' ry='25'/>" + kLamps);
  EXPECT_EQ(svg.scene.bodies.size(), 2u);
  EXPECT_EQ(reasons(svg), "<ellipse> in line 2 covers every light; ");
  const PlaneSvg line =
      load("<rect x='10' y='10' width='80' height='60'/><path class='light' d='M20 20L50 60' fill='none' stroke='#fff'/>");
  EXPECT_EQ(line.scene.bodies.size(), 1u) << "lights without thickness";
}

TEST(Backdrop, IsNotWhatLeavesLightInThePicture) {
  for (const std::string shape : {"<rect width='100' height='70'/>",                                     // light below it
                                  "<path fill-rule='evenodd' d='M-9 -9H109V89H-9Z M10 10H90V70H10Z'/>",  // a room
                                  "<path fill-rule='evenodd' d='M-9 -9H109V89H-9Z M45 45H50V50H45Z'/>",  // a small hole
                                  "<circle cx='50' cy='40' r='60'/>",                                    // corners are free
                                  "<path d='M-99 -99H300V300H-99V41H50V39H-99Z'/>"}) {                   // a slit
    const std::string lamp = "<circle class='light' cx='-150' cy='75' r='2' fill='#fff'/>";
    const PlaneSvg svg = load(shape + lamp + kLamps);
    EXPECT_EQ(svg.scene.bodies.size(), 4u) << shape << ": " << reasons(svg);
  }
  // One of two lamps is outside; a lamp is flush with a wall; a lamp lies in a hole; a lamp sticks out.
  EXPECT_EQ(load("<rect x='5' y='10' width='40' height='60'/>" + kLamps).scene.bodies.size(), 3u);
  const auto of_one = [](const std::string& shape) {
    return load(shape + "<rect class='light' x='20' y='20' width='10' height='10' fill='#fff'/>").scene.bodies.size();
  };
  EXPECT_EQ(of_one("<rect x='5' y='10' width='25' height='60'/>"), 2u);
  EXPECT_EQ(of_one("<rect x='20' y='20' width='10' height='10'/>"), 2u);
  EXPECT_EQ(of_one("<path fill-rule='evenodd' d='M5 5H60V60H5Z M15 15H40V40H15Z'/>"), 2u);
  EXPECT_EQ(of_one("<rect x='5' y='10' width='20' height='60'/>"), 2u);
  EXPECT_EQ(of_one("<rect x='5' y='10' width='40' height='60'/>"), 1u);
  const std::string sun = "<circle r='1' data-steradian='sun' data-sun-direction='-90 5' fill='#fff'/>";
  EXPECT_EQ(of_one(sun + "<rect x='5' y='10' width='40' height='60'/>"), 2u) << "a sun lights the picture";
  EXPECT_EQ(load("<rect x='5' y='10' width='40' height='60'/>").scene.bodies.size(), 1u) << "no lights to cover";
}

TEST(Backdrop, IsNotWhatSaysThatItBlocksOrActsOnLight) {
  for (const std::string says :
       {"data-steradian='occluder'", "class='occluder'", "data-transmittance='0.5'", "data-light-depth='9'", "data-mirror='0.5'"})
    EXPECT_EQ(load("<rect width='100' height='80' " + says + "/>" + kLamps).scene.bodies.size(), 3u) << says;
  EXPECT_EQ(load("<g inkscape:label='Occluders'><rect width='100' height='80'/></g>" + kLamps).scene.bodies.size(), 3u);
  EXPECT_EQ(load("<g inkscape:label='Background'><rect width='100' height='80'/></g>" + kLamps).scene.bodies.size(), 2u);
}

TEST(Backdrop, IsWrittenAsAnOccluderIfItBlocks) {
  const PlaneSvg svg = load("<rect width='100' height='80' data-steradian='occluder'/>" + kLamps);
  EXPECT_EQ(load_plane_scene_from_text(plane_scene_to_svg(svg.scene), "written.svg").scene.bodies.size(), 3u);
}

// A body that hides the only lamp for a while does not vanish meanwhile, and a backdrop at the beginning remains one.
TEST(Backdrop, StaysWhatItIsWhileThingsMove) {
  const auto at = [](const std::string& inside, double seconds) {
    const PlaneAnimation animation(svg_of(inside), "test.svg", {});
    return animation.at(seconds).scene.bodies.size();
  };
  const std::string lamp =
      "<circle class='light' cy='40' r='3' fill='#fff'><animate attributeName='cx' from='10' to='90' dur='8s'/></circle>";
  for (const double seconds : {0, 4, 7}) {
    EXPECT_EQ(at("<rect x='40' width='30' height='70'/>" + lamp, seconds), 2u) << seconds;
    EXPECT_EQ(at("<rect x='5' width='30' height='70'/>" + lamp, seconds), 1u) << seconds;
    EXPECT_EQ(at("<rect width='100' height='80'/>" + lamp, seconds), 1u) << seconds;
  }
}

TEST(Backdrop, LeftOutShapesAreCountedByReason) {
  const PlaneSvg svg = load(
      "<g id='hidden' style='display:none'><rect width='3' height='3'/></g><rect data-steradian='ignore' width='3' height='3'/>\n"
      "<rect id='glow' width='3' height='3' opacity='0'/>\n<path id='bare' d='M0 0H9V9Z' fill='none'/>\n"
      "<clipPath id='c'><rect width='5' height='5'/></clipPath><rect id='cut' x='50' width='3' height='3' clip-path='url(#c)'/>" +
      kLamps);
  EXPECT_EQ(reasons(svg),
            "hidden <rect> in line 2 not displayed, or its role is ignore; glow has no opacity; bare has no fill and no stroke; "
            "cut outside of its clip or mask; ");
  std::string many;
  for (int i = 0; i < 20; ++i) many += "<rect width='3' height='3' opacity='0'/>";
  const PlaneSvg counted = load(many);
  ASSERT_EQ(counted.left_out.size(), 1u);
  EXPECT_EQ(counted.left_out[0].count, 20u);
  EXPECT_EQ(counted.left_out[0].names.size(), 8u);
}

// A lamp in a wall, on floor tiles, in a hole of a wall, flush with a wall, half in it, in glass, and a line of light.
TEST(Backdrop, BuriedLightsAreNamed) {
  const std::string lamp = "<circle id='lamp' class='light' cx='50' cy='40' r='3' fill='#fff'/>",
                    other = "<circle id='other' class='light' cx='5' cy='5' r='3' fill='#fff'/>";
  const auto warnings = [&](const std::string& shapes) { return load(shapes).warnings; };
  const auto says = [&](const std::string& shapes, const std::string& part) {
    const std::vector<std::string> found = warnings(shapes);
    return found.size() == 1 && found[0].find(part) != std::string::npos;
  };
  EXPECT_TRUE(says("<rect id='wall' x='40' y='30' width='20' height='20'/>" + lamp + other, "lamp (in wall)"));
  EXPECT_TRUE(says("\n<circle cx='50' cy='40' r='20'/>" + lamp + other, "lamp (in <circle> in line 3)"));
  EXPECT_TRUE(
      says("<rect id='left' x='40' y='30' width='10' height='20'/><rect id='right' x='50' y='30' width='10' height='20'/>" + lamp + other,
           "lamp (in "));
  EXPECT_TRUE(
      says("<rect id='wall' x='40' y='30' width='20' height='20'/><path id='neon' class='light' stroke='#fff' fill='none' "
           "d='M45 35H55'/>" +
               other,
           "neon (in wall)"));
  EXPECT_TRUE(warnings("<path fill-rule='evenodd' d='M40 30h20v20h-20z M45 35h10v10h-10z'/>" + lamp + other).empty());
  EXPECT_TRUE(warnings("<rect x='40' y='43' width='20' height='20'/>" + lamp + other).empty());
  EXPECT_TRUE(warnings("<rect x='40' y='40' width='20' height='20'/>" + lamp + other).empty());
  EXPECT_TRUE(warnings("<rect x='40' y='30' width='20' height='20' data-transmittance='0.5'/>" + lamp + other).empty());
  EXPECT_TRUE(warnings("<rect x='40' y='30' width='20' height='20' data-steradian='ignore'/>" + lamp + other).empty());
  std::string many = "<rect id='wall' x='40' y='30' width='20' height='20'/>" + other;
  for (int i = 0; i < 12; ++i) many += lamp;
  EXPECT_TRUE(says(many, "and 4 more"));
}

// A lamp drawn in another is no occluder's.
TEST(Backdrop, LightsBuryNoLights) {
  EXPECT_TRUE(load("<circle class='light' cx='50' cy='40' r='9' fill='#fff'/>" + kLamps).warnings.empty());
}

TEST(Backdrop, StrokesThatAreNotDrawnAreNamed) {
  const auto ignored = [](const std::string& shapes) {
    const PlaneSvg svg = load(shapes);
    std::string all;
    for (const std::string& what : svg.ignored) all += what + ";";
    return all;
  };
  EXPECT_EQ(ignored("<rect width='9' height='9' stroke='#fff'/>" + kLamps), "stroke of a filled shape;");
  EXPECT_EQ(ignored("<rect width='9' height='9' stroke='#fff' stroke-width='0'/>" + kLamps), "");
  EXPECT_EQ(ignored("<rect width='9' height='9' fill='none' stroke='#fff' stroke-width='2'/>" + kLamps), "");
  EXPECT_EQ(ignored("<path d='M0 0H9' fill='none' stroke='#fff' stroke-width='2' stroke-dasharray='3 1'/>" + kLamps),
            "stroke-dasharray (the line has no gaps);");
  EXPECT_EQ(ignored("<path d='M0 0H9' fill='none' stroke='#fff' stroke-width='2' stroke-dasharray='none'/>" + kLamps), "");
  EXPECT_EQ(ignored("<text x='5' y='20' fill='none' stroke='#fff'>a</text>" + kLamps), "stroke of text;");
}

// Nested covers and many lights are judged in time, or refused.
TEST(Backdrop, IsJudgedWithinTheLimits) {
  std::string inside;
  for (int i = 0; i < 3000; ++i)
    inside += "<rect x='1' y='1' width='98' height='78'/><circle class='light' cx='50' cy='40' r='3' fill='#fff'/>";
  try {
    EXPECT_EQ(load(inside).scene.bodies.size(), 3000u);
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("test.svg"), std::string::npos) << e.what();
  }
}

}  // namespace steradian::plane::backdrop_test
