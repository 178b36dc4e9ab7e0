#pragma once
// A small team of threads for loops that take microseconds.
//
// Work is cut by index, never by who comes first, wherever the order of additions could show in a result; so every
// result is the same for any number of threads. A waiting thread spins for a tenth of a millisecond, then sleeps: quick
// when the machine is ours, polite when it is not. Built on the standard library alone, so that thread sanitizers see
// it.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace polder {

/// part(r, begin, end) for consecutive parts of [0, count) of about equal weight, the sum of weight(i) ≥ 0: each ends
/// with the item whose middle is the last before its share of the whole.
template <class Weight, class Part>
void cut_in_parts(std::ptrdiff_t count, int parts, Weight&& weight, Part&& part) {
  std::ptrdiff_t total = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) total += weight(i);
  std::ptrdiff_t passed = 0, begin = 0, end = 0;
  for (int r = 0; r < parts; ++r, begin = end) {
    for (; end < count; ++end) {
      const std::ptrdiff_t own = weight(end);
      if (r + 1 < parts && (2 * passed + own) * parts > 2 * total * (r + 1)) break;
      passed += own;
    }
    part(r, begin, end);
  }
}

class Team {
 public:
  /// `threads` ≥ 1; 0: as many as the machine has.
  explicit Team(int threads = 1);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return size_; }

  /// Calls body(rank) once on every thread, rank 0 on the caller's, and returns when all are done.
  void run(const std::function<void(int)>& body);

  /// Inside run(): waits until every thread is here.
  void barrier();

  /// body(begin, end) over consecutive shares of [0, count).
  template <class Body>
  void share(std::ptrdiff_t count, Body&& body) {
    if (size_ == 1 || count < 2) {
      if (count > 0) body(std::ptrdiff_t{0}, count);
      return;
    }
    run([&](int rank) {
      const auto [begin, end] = part(count, rank);
      if (begin < end) body(begin, end);
    });
  }

  /// body(i) for each i in [0, count): for items of unequal weight that do not touch each other. Thread r begins with
  /// its own consecutive part, whose data are likely still in its cache from the last loop, then helps the others. The
  /// parts are of about equal weight, where weight(i) is given.
  template <class Body>
  void each(std::ptrdiff_t count, Body&& body) {
    each(count, body, [](std::ptrdiff_t) { return std::ptrdiff_t{1}; });
  }
  template <class Body, class Weight>
  void each(std::ptrdiff_t count, Body&& body, Weight&& weight) {
    if (size_ == 1 || count < 2) {
      for (std::ptrdiff_t i = 0; i < count; ++i) body(i);
      return;
    }
    cut_in_parts(count, size_, weight, [this](int r, std::ptrdiff_t begin, std::ptrdiff_t end) {
      next_[r].item.store(begin, std::memory_order_relaxed);
      next_[r].end = end;
    });
    run([&](int rank) {
      for (int turn = 0; turn < size_; ++turn) {
        Next& next = next_[(rank + turn) % size_];
        for (auto i = next.item.fetch_add(1); i < next.end; i = next.item.fetch_add(1)) body(i);
      }
    });
  }

  std::pair<std::ptrdiff_t, std::ptrdiff_t> part(std::ptrdiff_t count, int rank) const {
    return {count * rank / size_, count * (rank + 1) / size_};
  }

 private:
  void work(int rank);
  static void wait_until_changed(std::atomic<unsigned>& value, unsigned seen);

  struct alignas(64) Next {
    std::atomic<std::ptrdiff_t> item{0};
    std::ptrdiff_t end = 0;
  };

  int size_;
  std::vector<Next> next_;  // of each thread's part in each()
  std::vector<std::jthread> workers_;
  const std::function<void(int)>* body_ = nullptr;
  bool stop_ = false;
  alignas(64) std::atomic<unsigned> round_{0};
  alignas(64) std::atomic<unsigned> arrived_{0};
  alignas(64) std::atomic<unsigned> passed_{0};
};

/// Σ term(i) over [0, count), in an order that does not depend on the number of threads: blocks of fixed size, added in
/// sequence. Terms are numbers, or what adds up by += from {}.
template <class Term>
auto ordered_sum(Team& team, std::ptrdiff_t count, Term&& term) {
  using Sum = decltype(term(std::ptrdiff_t{0}));
  constexpr std::ptrdiff_t block = 1024;
  const std::ptrdiff_t blocks = (count + block - 1) / block;
  std::vector<Sum> partial(static_cast<std::size_t>(blocks), Sum{});
  team.share(blocks, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t b = begin; b < end; ++b) {
      Sum sum{};
      for (std::ptrdiff_t i = b * block; i < std::min(count, (b + 1) * block); ++i) sum += term(i);
      partial[static_cast<std::size_t>(b)] = sum;
    }
  });
  Sum sum{};
  for (const Sum& p : partial) sum += p;
  return sum;
}

}  // namespace polder
