// A flag that becomes true after some seconds.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace steradian::app {

class Alarm {
 public:
  explicit Alarm(double seconds);  // infinity: never
  ~Alarm();
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;

  bool is_set() const { return set_; }
  const std::atomic<bool>& rung() const { return rung_; }

 private:
  bool set_;
  std::atomic<bool> rung_;
  bool over_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace steradian::app
