// Everything public. See the single headers: each is the manual of its topic.
#pragma once

#include "steradian/error.h"
#include "steradian/dual.h"
#include "steradian/kernels.h"
#include "steradian/albedo.h"
#include "steradian/closed_form.h"
#include "steradian/capsule_light.h"
#include "steradian/ellipse_light.h"
#include "steradian/half_vector.h"
#include "steradian/load_scene.h"
#include "steradian/polygon_derivatives.h"
#include "steradian/polygon_light.h"
#include "steradian/scene.h"
#include "steradian/version.h"
