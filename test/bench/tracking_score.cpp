// SPDX-License-Identifier: BSD-3-Clause
#include "tracking_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sarn_perception/assignment.h"

namespace sarn_tests {

double TrackingScore::rms(const Squares& squares) { return std::sqrt(ratio(squares.sum, squares.count)); }

std::vector<int> TrackingScore::match(const std::vector<TruePerson>& truth,
                                      const std::vector<ReportedPerson>& reported) const {
  std::vector<int> matches(truth.size(), -1);
  std::vector<bool> taken(reported.size(), false);
  const auto distance = [&](std::size_t i, std::size_t j) {
    return (truth[i].position - reported[j].position).norm();
  };
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto before = report_of_.find(truth[i].id);
    if (before == report_of_.end()) continue;
    for (std::size_t j = 0; j < reported.size(); ++j) {
      if (reported[j].id != before->second || taken[j] || distance(i, j) >= match_distance_) continue;
      matches[i] = static_cast<int>(j);
      taken[j] = true;
    }
  }
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(truth.size()),
                                                   static_cast<Eigen::Index>(reported.size()),
                                                   std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (std::size_t j = 0; j < reported.size(); ++j) {
      if (matches[i] >= 0 || taken[j]) continue;
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = distance(i, j);
    }
  }
  const std::vector<int> others = sarn_perception::assign(cost, match_distance_);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (matches[i] < 0) matches[i] = others[i];
  }
  return matches;
}

void TrackingScore::add(const std::vector<TruePerson>& truth, const std::vector<ReportedPerson>& reported,
                        double stamp, bool turning) {
  const std::vector<int> matches = match(truth, reported);
  std::vector<bool> right(reported.size(), false);
  last_matches_.clear();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    time(truth[i], matches[i] >= 0, stamp);
    if (matches[i] >= 0) last_matches_[truth[i].id] = reported[static_cast<std::size_t>(matches[i])].id;
    if (matches[i] < 0) {
      if (truth[i].visible) missed_ += 1.0;
      continue;
    }
    const auto j = static_cast<std::size_t>(matches[i]);
    const ReportedPerson& report = reported[j];
    right[j] = true;
    const auto before = report_of_.find(truth[i].id);
    if (before != report_of_.end() && before->second != report.id) switches_ += 1.0;
    report_of_[truth[i].id] = report.id;
    if (!truth[i].visible) continue;
    right_ += 1.0;
    distance_ += (truth[i].position - report.position).norm();
    const double error = (truth[i].velocity - report.velocity).squaredNorm();
    const bool settled = report.age >= 0.5;
    all_.add(error);
    if (turning) turning_.add(error);
    if (settled) settled_.add(error);
    if (settled && turning) settled_turning_.add(error);
    if (settled && turning && truth[i].steady) steady_turning_.add(error);
  }
  for (std::size_t j = 0; j < reported.size(); ++j) {
    if (!right[j]) wrong_ += 1.0;
    Life& life = lives_.try_emplace(reported[j].id, Life{stamp, stamp, false}).first->second;
    life.end = stamp;
    life.right = life.right || right[j];
  }
}

void TrackingScore::time(const TruePerson& person, bool reported, double stamp) {
  bool& in_view = in_view_.try_emplace(person.id, false).first->second;
  const bool came = person.visible && !in_view;
  in_view = person.visible;
  if (came) waiting_[person.id] = stamp;
  const auto waiting = waiting_.find(person.id);
  if (waiting == waiting_.end()) return;
  if (person.visible && reported) latency_.add(stamp - waiting->second);
  if (!person.visible || reported) waiting_.erase(waiting);
}

double TrackingScore::longestGhost() const {
  double longest = longest_ghost_;
  for (const auto& [id, life] : lives_) {
    if (!life.right) longest = std::max(longest, life.end - life.begin);
  }
  return longest;
}

void TrackingScore::nextRun() {
  longest_ghost_ = longestGhost();
  lives_.clear();
  report_of_.clear();
  waiting_.clear();
  in_view_.clear();
}

}  // namespace sarn_tests
