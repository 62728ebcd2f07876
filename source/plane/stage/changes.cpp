// Updates of a prepared scene when one of its bodies moves, changes, is added or is removed.
#include <algorithm>

#include "plane/frame/emitters.h"
#include "plane/frame/runs/reaching.h"
#include "plane/stage/preparation.h"

namespace steradian::plane {

// Marks the emitters whose lists contain the body, and the lights that it may reach into.
void Preparation::touch(std::size_t body) {
  for (std::size_t k = first_blocker_[body]; k < first_blocker_[body] + blocker_count_[body]; ++k) {
    const Blocker& b = frame_.blockers[k];
    if (b.level != 0) continue;  // that of which it is a part represents it
    for (std::size_t i = 0; i < frame_.emitters.size(); ++i) {
      const Emitter& e = frame_.emitters[i];
      const Vec2d away = b.center - e.center;
      const double reach = std::min(e.range, 1e8) + e.bound + b.bound;
      if (dot(away, away) < reach * reach * (1 + 1e-12)) dirty_[i] = 1;
    }
  }
  const Box2d& box = world_.boxes[body];
  for (std::size_t i = 0; i < world_.boxes.size(); ++i)
    if (box.meets(world_.boxes[i])) dirty_interior_[i] = 1;
}

void Preparation::forget(std::size_t body) {
  touch(body);
  for (std::size_t k = first_blocker_[body]; k < first_blocker_[body] + blocker_count_[body]; ++k)
    if (frame_.blockers[k].level == 0) bins_.remove(static_cast<int>(k), frame_.blockers[k]);
}

bool Preparation::take(std::size_t body) {
  if (body == first_blocker_.size()) {
    frame_.general.push_back(0);
    frame_.convex.push_back(0);
    frame_.interior.emplace_back();
    dirty_interior_.push_back(1);
    first_blocker_.push_back(frame_.blockers.size());
    add_blockers(body);
    blocker_count_.push_back(frame_.blockers.size() - first_blocker_.back());
    first_emitter_.push_back(frame_.emitters.size());
    if (this->body(body).light) add_emitters(body);
    emitter_count_.push_back(frame_.emitters.size() - first_emitter_.back());
    dirty_.resize(frame_.emitters.size());
    if (frame_.general[body] != 0) return false;
  } else if (!take_blockers(body) || !take_emitters(body)) {
    return false;
  }
  for (std::size_t k = first_blocker_[body]; k < first_blocker_[body] + blocker_count_[body]; ++k)
    if (frame_.blockers[k].level == 0) bins_.insert(static_cast<int>(k), frame_.blockers[k]);
  touch(body);
  std::fill_n(dirty_.begin() + static_cast<std::ptrdiff_t>(first_emitter_[body]), emitter_count_[body], 1);
  return true;
}

// Writes the blockers to the same places as before.
bool Preparation::take_blockers(std::size_t body) {
  const std::size_t at = frame_.blockers.size(), vertices = frame_.vertices.size(), outlines = frame_.outlines.size();
  const std::size_t first = first_blocker_[body], count = blocker_count_[body];
  const char convex = frame_.convex[body];
  add_blockers(body);
  if (frame_.blockers.size() - at != count || frame_.convex[body] != convex) return false;
  for (std::size_t k = 0; k < count; ++k) {
    Blocker& before = frame_.blockers[first + k];
    Blocker now = frame_.blockers[at + k];
    if (now.kind != before.kind || now.count != before.count || now.edges != before.edges || now.chains != before.chains ||
        now.level != before.level)
      return false;
    for (std::size_t v = 0; v < now.count; ++v) frame_.vertices[before.first + v] = frame_.vertices[now.first + v];
    now.first = before.first;
    if (now.outline >= 0) {
      frame_.outlines[static_cast<std::size_t>(before.outline)] = frame_.outlines[static_cast<std::size_t>(now.outline)];
      now.outline = before.outline;
    }
    if (now.edges != 0) now.first_edge = before.first_edge, now.first_chain = before.first_chain;
    before = now;
  }
  frame_.blockers.resize(at);
  frame_.vertices.resize(vertices);
  frame_.outlines.resize(outlines);
  return true;
}

bool Preparation::take_emitters(std::size_t body) {
  if (!this->body(body).light) return emitter_count_[body] == 0;
  const std::optional<std::vector<Emitter>> emitters = emitters_of(world_, body);
  if (!emitters || emitters->size() != emitter_count_[body]) return false;
  const auto first = frame_.emitters.begin() + static_cast<std::ptrdiff_t>(first_emitter_[body]);
  const auto alike = [](const Emitter& a, const Emitter& b) { return a.kind == b.kind && a.group == b.group; };
  if (!std::equal(emitters->begin(), emitters->end(), first, alike)) return false;
  for (std::size_t k = 0; k < emitters->size(); ++k) {
    const bool hidden = first[static_cast<std::ptrdiff_t>(k)].hidden;
    first[static_cast<std::ptrdiff_t>(k)] = (*emitters)[k];
    first[static_cast<std::ptrdiff_t>(k)].hidden = hidden;
  }
  return true;
}

void Preparation::drop(std::size_t body) {
  blocker_count_[body] = 0;
  frame_.convex[body] = 0;
  frame_.interior[body] = {};
  for (std::size_t e = first_emitter_[body]; e < first_emitter_[body] + emitter_count_[body]; ++e) {
    frame_.emitters[e].hidden = true;
    frame_.nearby_count[e] = 0;
    frame_.whole_run[e] = 0;
    frame_.filled_run[e] = 0;
    dirty_[e] = 0;
  }
  emitter_count_[body] = 0;
  ++gone_;
}

bool Preparation::finish() {
  const bool outgrown = frame_.blockers.size() > 2 * made_blockers_ + 4096 || frame_.nearby.size > 3 * made_pairs_ + 65536 ||
                        first_blocker_.size() > made_bodies_ + made_bodies_ / 4 + 64 || gone_ > made_bodies_ / 2 + 64;
  if (outgrown || find_slack() != frame_.slack) return false;
  const Budget before = budget_;  // each change has the whole budget
  for (std::size_t i = 0; i < dirty_interior_.size(); ++i)
    if (dirty_interior_[i] != 0) find_interior(frame_, i, bins_, budget_, [this](std::uint64_t steps) { spend(steps); });
  for (std::size_t e = 0; e < dirty_.size(); ++e)
    if (dirty_[e] != 0 && !(frame_.emitters[e].hidden && emitter_count_[static_cast<std::size_t>(frame_.emitters[e].body)] == 0))
      make_list(e);
  budget_ = before;
  std::fill(dirty_.begin(), dirty_.end(), 0);
  std::fill(dirty_interior_.begin(), dirty_interior_.end(), 0);
  return true;
}

}  // namespace steradian::plane
