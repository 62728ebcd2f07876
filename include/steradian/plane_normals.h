// Normal maps lit by a picture of the plane and its first moments: sprites that are lit as if they had a relief.
//
//   options.moments = true;
//   Picture lit = light_normals(render_plane(world, options), normals, 0.6);
#pragma once

#include "steradian/picture.h"

namespace steradian {

// Lamps are at the angle lamp_height (radians, within 0 and pi / 2) above the plane. With M0 a pixel's light and M its first moment,
//
//   lit = max(0, cos(lamp_height) (nx Mx + ny My) + nz sin(lamp_height) M0)
//
// which is exact if all directions of the light are above the surface, or all below it. This always holds if the normal's tilt is at most
// lamp_height. Elsewhere the part below the surface is subtracted instead of omitted, and the result is too dark.
//
// light: a picture with layers "moment_x" and "moment_y". normals: a picture of the same size with (nx, ny, nz) in each pixel, of length 1,
// y downwards and z to the eye. Its layer "alpha", if it has one, becomes that of the result. Throws Error if sizes or layers do not fit.
Picture light_normals(const Picture& light, const Picture& normals, double lamp_height);

// The normals of a normal map: 2 c - 1 for each channel, made unit length; green is upwards. encoded_srgb: the picture was read from a file
// of 8 bits, whose values read_picture took for sRGB.
Picture normals_of_map(const Picture& map, bool encoded_srgb);

}  // namespace steradian
