// Exchange areas of pairs with triangles between them: the closed form less the integral of what the triangles hide.
#pragma once

#include "exchange/obstacles/obstacles.h"
#include "exchange/pairs/pair.h"

namespace steradian::exchange {

// The visible exchange area of two elements: never below 0, never above the unobstructed one.
struct VisibleExchange {
  ExchangeArea visible;
  ExchangeArea unobstructed;
  bool is_obstructed = false;  // some triangle may lie between
};
// The hidden part is integrated over the first element; exchanging the elements is a check.
VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps);
// The same where the unobstructed exchange area is known.
VisibleExchange visible_exchange(const PlaneElement& a, const PlaneElement& b, const Obstacles& obstacles, double eps,
                                 const ExchangeArea& unobstructed);

}  // namespace steradian::exchange
