#include "steradian/material.h"

namespace steradian {

const char* name_of(Brdf brdf) {
  switch (brdf) {
    case Brdf::lambert: return "lambert";
    case Brdf::phong: return "phong";
    case Brdf::ggx: return "ggx";
    case Brdf::blinn_phong: return "blinn-phong";
    case Brdf::beckmann: return "beckmann";
    case Brdf::charlie: return "charlie";
  }
  return "?";
}

}  // namespace steradian
