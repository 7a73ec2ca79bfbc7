// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace kobuki_sim {

/// Threads that wait for pieces of work; the calling thread takes part. Not to be used by two callers at
/// once.
class WorkerPool {
 public:
  /// `threads` >= 1, the caller included.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Calls work(begin, end) on parts of [0, count) that cover it once, and returns when all are done. `work`
  /// must not throw.
  void run(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);
  [[nodiscard]] int threads() const { return static_cast<int>(workers_.size()) + 1; }

 private:
  void serve();
  void takeParts();

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<std::uint64_t> round_{0};
  std::atomic<bool> stop_{false};
  const std::function<void(std::size_t, std::size_t)>* work_ = nullptr;
  std::size_t count_ = 0;
  std::size_t part_ = 1;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> open_{false};  // the round's work may be taken
  std::atomic<int> active_{0};     // workers who look at the round's work
};

}  // namespace kobuki_sim
