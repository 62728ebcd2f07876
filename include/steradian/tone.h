// ToneCurve: mapping of radiance that a screen cannot show to a colour that it can. The default is `neutral` (picture.h).
#pragma once

#include <string>

#include "steradian/picture.h"

namespace steradian {

// neutral   Khronos, "PBR Neutral Tone Mapper", 2024: base colours up to 0.8 - 0.04 pass unchanged in hue and value
// clip      unchanged; values above 1 become 1
// reinhard  Reinhard et al., "Photographic tone reproduction for digital images", 2002, equation 3: luminance L becomes L / (1 + L)
// filmic    Narkowicz, "ACES filmic tone mapping curve", 2015: with the toe and the shoulder of film, channel by channel
enum class ToneCurve { neutral, clip, reinhard, filmic };
inline constexpr ToneCurve kToneCurves[] = {ToneCurve::neutral, ToneCurve::clip, ToneCurve::reinhard, ToneCurve::filmic};

const char* name_of(ToneCurve curve);
ToneCurve tone_curve_named(const std::string& name);  // throws UsageError with the known names

// Colour that a picture shows: exposure in stops, the curve, sRGB. In and out in [0, 1] per channel.
Vec3f tone_map(Vec3f radiance, float exposure_stops, ToneCurve curve);

// Like write_picture(picture, path, exposure_stops): `.png` by this curve, `.exr` linear.
void write_picture(const Picture& picture, const std::string& path, float exposure_stops, ToneCurve curve);

}  // namespace steradian
