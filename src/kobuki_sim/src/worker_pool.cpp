// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/worker_pool.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace kobuki_sim {
namespace {

// A worker looks for the next round so often before it goes to sleep: rounds that follow each other within
// some ten microseconds find it awake.
constexpr int kSpins = 2000;
constexpr std::size_t kPartsPerThread = 4;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

WorkerPool::WorkerPool(int threads) {
  if (threads < 1) throw std::invalid_argument("threads: " + std::to_string(threads) + " is below 1");
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { serve(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::takeParts() {
  while (true) {
    const std::size_t begin = next_.fetch_add(part_);
    if (begin >= count_) return;
    (*work_)(begin, std::min(begin + part_, count_));
  }
}

void WorkerPool::serve() {
  std::uint64_t seen = 0;
  while (true) {
    for (int i = 0; i < kSpins && round_.load(std::memory_order_acquire) == seen && !stop_; ++i) pause();
    if (round_.load(std::memory_order_acquire) == seen) {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, [&] { return round_.load() != seen || stop_; });
    }
    if (stop_) return;
    seen = round_.load(std::memory_order_acquire);
    // Announce first, look then: a caller who closes the round waits for everyone who was announced before.
    active_.fetch_add(1);
    if (open_.load()) takeParts();
    active_.fetch_sub(1);
  }
}

void WorkerPool::run(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
  const auto all = static_cast<std::size_t>(threads());
  if (workers_.empty() || count < 2) {
    if (count > 0) work(0, count);
    return;
  }
  work_ = &work;
  count_ = count;
  part_ = std::max<std::size_t>(1, count / (all * kPartsPerThread));
  next_ = 0;
  open_ = true;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    round_.fetch_add(1, std::memory_order_release);
  }
  wake_.notify_all();
  takeParts();
  // All parts are taken; those who came in time finish theirs, who wakes up later finds the round closed.
  open_ = false;
  while (active_.load() > 0) pause();
}

}  // namespace kobuki_sim
