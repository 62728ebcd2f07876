// A scene prepared for frames, and updated while its bodies change. The emitters, blockers and lists that a change affects are computed
// again, in the order in which a new preparation would compute them.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/frame/scene.h"
#include "plane/frame/tiles/blocker_bins.h"

namespace steradian::plane {

class Preparation {
 public:
  // Throws Error if the lights and their possible blockers exceed the budget. The world and the budget must outlive it.
  Preparation(const World& world, Budget& budget, const FrameLights& lights);

  FrameScene& frame() { return frame_; }
  const FrameScene& frame() const { return frame_; }

  // The bodies of the world change one after another: call `forget` before, `take` after, then `finish`. They return false for a change
  // that does not fit the lists (another number of edges, say): the scene must then be prepared anew.
  void forget(std::size_t body);                                   // the emitters that it occludes
  bool take(std::size_t body);                                     // the body as it is now; a new body is the last one
  void drop(std::size_t body);                                     // a body that has been removed
  bool recolour(std::size_t body) { return take_emitters(body); }  // instead of all three
  bool finish();

 private:
  const PlaneBody& body(std::size_t i) const { return world_.scene.bodies[i]; }

  // Bodies and limits: scene.cpp.
  void check_bodies();
  void check_pairs();
  void check_general();
  void spend(std::uint64_t steps);
  void add_convex(const std::vector<Vec2d>& vertices, int owner);
  void add_ellipse(const PlaneEllipse& e, int owner);
  std::vector<Vec2d> convex_outline(std::size_t i) const;
  void add_blockers(std::size_t i);
  void add_emitters(std::size_t i);
  double find_slack() const;

  // Changes: changes.cpp.
  bool take_blockers(std::size_t body);
  bool take_emitters(std::size_t body);
  void touch(std::size_t body);

  // Possible blockers of an emitter: nearby.cpp.
  enum class ChainView { behind, whole, edge_by_edge };
  ChainView view_of_chain(const Emitter& e, const Blocker& chain) const;
  bool is_clear(const Emitter* run, bool& filled);
  bool is_behind_outline(const Emitter& run, int edge) const;
  std::size_t curve_of(const Emitter& e, int blocker) const;
  bool is_of_run(const Emitter* run, int blocker) const;
  void make_list(std::size_t index);
  void find_nearby(std::size_t index, std::vector<int>& list);
  void write_list(std::size_t index, const std::vector<int>& list);
  void add_private(const std::vector<Vec2d>& vertices, int owner, std::vector<int>& list);
  void add_in_front(const Emitter& e, Vec2d p, Vec2d q, int owner, std::vector<int>& list);
  void own_edge(const Emitter& e, int blocker, std::vector<int>& list);
  void rest_of_edge(const Emitter& run, int blocker, std::vector<int>& list);
  void stand_in(Emitter& e, int blocker, std::vector<int>& list);

  const World& world_;
  const FrameLights lights_;
  FrameScene frame_;
  std::vector<std::size_t> first_blocker_, blocker_count_;  // by body
  std::vector<std::size_t> first_emitter_, emitter_count_;
  std::vector<std::size_t> room_;  // by emitter: the capacity of its list
  std::vector<int> first_pair_;    // by emitter, for disks: in FrameScene::pairs
  BlockerBins bins_;
  Budget& budget_;
  std::uint64_t steps_ = 0;
  std::size_t blockers_held_ = 0, made_bodies_ = 0, made_blockers_ = 0, made_pairs_ = 0, gone_ = 0;
  // State of the changes under way.
  std::vector<char> dirty_;           // by emitter: its list must be computed again
  std::vector<char> dirty_interior_;  // by body
};

}  // namespace steradian::plane
