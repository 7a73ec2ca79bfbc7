// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/planning_worker.h"

#include <stdexcept>
#include <utility>

namespace sarn_navigation {

PlanningWorker::PlanningWorker(PlanFunction plan) : plan_(std::move(plan)), thread_([this] { run(); }) {}

PlanningWorker::~PlanningWorker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PlanningWorker::submit(PlanningJob job) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (job_) throw std::logic_error("PlanningWorker::submit: a search is running");
    result_.reset();
    job_ = std::move(job);
  }
  changed_.notify_all();
}

bool PlanningWorker::busy() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return job_.has_value();
}

std::optional<lattice_planner::PlanResult> PlanningWorker::poll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(result_, std::nullopt);
}

void PlanningWorker::wait() const {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !job_; });
}

void PlanningWorker::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || job_; });
    if (stop_) return;
    const PlanningJob job = *job_;
    lock.unlock();
    lattice_planner::PlanResult result = plan_(job.request, *job.scene);
    lock.lock();
    result_ = std::move(result);
    job_.reset();
    changed_.notify_all();
  }
}

}  // namespace sarn_navigation
