// Normal maps lit by a picture of the plane and its first moments: sprites that are lit as if they had a relief.
//
//   options.moments = true;
//   Picture lit = light_normals(render_plane(world, options), normals, 0.6);
#pragma once

#include "steradian/picture.h"

namespace steradian {

// Lamps stand at the angle lamp_height (radians, within 0 and pi / 2) above the plane. With M0 a pixel's light and M its first moment,
//
//   lit = max(0, cos(lamp_height) (nx Mx + ny My) + nz sin(lamp_height) M0)
//
// which is exact where all directions that light comes from are above the surface, or all below it: always, where the normal's tilt is no
// more than lamp_height. Elsewhere what is below the surface is taken away instead of left out, and the result is too dark.
//
// light: a picture with layers "moment_x" and "moment_y". normals: of the same size, of each pixel (nx, ny, nz), of length 1, y downwards
// and z to the eye; its layer "alpha", if it has one, is that of the result. Throws Error where sizes or layers do not fit.
Picture light_normals(const Picture& light, const Picture& normals, double lamp_height);

// The normals of a normal map: 2 c - 1 of each channel, made unit length; green is upwards. encoded_srgb: the picture was read from a file
// of 8 bits, whose values read_picture took for sRGB.
Picture normals_of_map(const Picture& map, bool encoded_srgb);

}  // namespace steradian
