// A scene made ready for frames, and kept so while its bodies change: the emitters, blockers and lists that a change touches are made
// again, in the order in which a new preparation would make them.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/frame/blocker_bins.h"
#include "plane/frame/scene.h"

namespace steradian::plane {

class Preparation {
 public:
  // Throws Error where the lights and what may block them are more than the budget allows. The world and the budget must outlive it.
  Preparation(const World& world, Budget& budget, const FrameLights& lights);

  FrameScene& frame() { return frame_; }
  const FrameScene& frame() const { return frame_; }

  // One body of the world after another changes: `forget` is called before, `take` after, then `finish`. What has no place in the lists as
  // they are (another number of edges, say) makes them return false: the scene is then to be prepared anew.
  void forget(std::size_t body);                                   // what it stands in front of
  bool take(std::size_t body);                                     // as it is now; a new body is the last one
  void drop(std::size_t body);                                     // that is gone
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
  void add_ellipse(const Ellipse& e, int owner);
  std::vector<Vec2d> convex_outline(std::size_t i) const;
  void add_blockers(std::size_t i);
  void add_emitters(std::size_t i);
  double find_slack() const;

  // Changes: changes.cpp.
  bool take_blockers(std::size_t body);
  bool take_emitters(std::size_t body);
  void touch(std::size_t body);

  // What may stand before an emitter: nearby.cpp.
  enum class ChainView { behind, whole, edge_by_edge };
  ChainView view_of_chain(const Emitter& e, const Blocker& chain) const;
  bool is_clear(const Emitter* run);
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
  std::vector<std::size_t> room_;  // by emitter: of its list
  std::vector<int> first_pair_;    // of a disk: in FrameScene::pairs
  BlockerBins bins_;
  Budget& budget_;
  std::uint64_t steps_ = 0;
  std::size_t blockers_held_ = 0, made_bodies_ = 0, made_blockers_ = 0, made_pairs_ = 0, gone_ = 0;
  // Of the changes under way.
  std::vector<char> dirty_;           // by emitter: its list is to be made again
  std::vector<char> dirty_interior_;  // by body
};

}  // namespace steradian::plane
