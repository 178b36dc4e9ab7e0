#include "polder/math/threads.hpp"

#include <algorithm>

namespace polder {

namespace {
constexpr int spins_before_sleep = 6000;  // about a tenth of a millisecond
}

Team::Team(int threads)
    : size_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      next_(static_cast<std::size_t>(size_)) {
  workers_.reserve(static_cast<std::size_t>(size_ - 1));
  for (int rank = 1; rank < size_; ++rank) workers_.emplace_back([this, rank] { work(rank); });
}

Team::~Team() {
  stop_ = true;
  round_.fetch_add(1);
  round_.notify_all();
}

void Team::wait_until_changed(std::atomic<unsigned>& value, unsigned seen) {
  for (int spin = 0; spin < spins_before_sleep; ++spin) {
    if (value.load(std::memory_order_acquire) != seen) return;
    __builtin_ia32_pause();
  }
  while (value.load(std::memory_order_acquire) == seen) value.wait(seen, std::memory_order_acquire);
}

void Team::barrier() {
  if (size_ == 1) return;
  const unsigned seen = passed_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == static_cast<unsigned>(size_)) {
    arrived_.store(0, std::memory_order_relaxed);
    passed_.fetch_add(1, std::memory_order_release);
    passed_.notify_all();
  } else {
    wait_until_changed(passed_, seen);
  }
}

void Team::run(const std::function<void(int)>& body) {
  if (size_ == 1) {
    body(0);
    return;
  }
  body_ = &body;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  body(0);
  barrier();
}

void Team::work(int rank) {
  unsigned seen = 0;
  while (true) {
    wait_until_changed(round_, seen);
    seen = round_.load(std::memory_order_acquire);
    if (stop_) return;
    (*body_)(rank);
    barrier();
  }
}

}  // namespace polder
