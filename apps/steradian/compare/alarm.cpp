#include "compare/alarm.h"

#include <chrono>
#include <cmath>

namespace steradian::app {

Alarm::Alarm(double seconds) : set_(!std::isinf(seconds)), rung_(seconds <= 0) {
  if (rung_ || !set_) return;
  thread_ = std::thread([this, seconds] {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return over_; })) rung_ = true;
  });
}

Alarm::~Alarm() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

}  // namespace steradian::app
