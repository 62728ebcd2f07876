// The judges of the study of CIE 171: closed forms of configuration factors, and quadrature. They share no code with the library.
#pragma once

#include "steradian/vector.h"

namespace steradian::cie171 {

// A rectangle with sides along the axes.
struct Span {
  double low, high;
};

// Configuration factor of a point for a rectangle in a parallel plane at a distance. The spans count from the point.
double parallel_factor(Span x, Span y, double distance);

// The same in a perpendicular plane. The normal of the point is x, and the rectangle lies in front.
double perpendicular_factor(Span x, Span y, double distance);

// View factor of two equal parallel rectangles a x b that face each other at a distance.
double facing_rectangles(double a, double b, double distance);

// View factor of two perpendicular rectangles with a common edge of 1: from the one of depth w to the one of height h.
double joined_rectangles(double h, double w);

// Part of the horizontal illuminance under a whole overcast sky (1 + 2 sin)/3 that a horizontal point receives through a rectangle in the
// plane z = distance (horizontal), or in the plane y = distance with z from the second span (vertical). By quadrature.
double overcast_through_roof(Span x, Span y, double distance);
double overcast_through_wall(Span x, Span z, double distance);

}  // namespace steradian::cie171
