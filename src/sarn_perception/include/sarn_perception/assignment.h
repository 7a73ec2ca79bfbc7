// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sarn_perception {

/// Global nearest neighbour: gives each row at most one column and each column at most one row, so that the
/// sum of the costs given plus `limit` for each row without a column is least. A pair is never given when it
/// costs `limit` or more (or is not finite). The column of each row; -1: none.
///
/// Hungarian method (Kuhn 1955) with potentials and shortest augmenting paths (Jonker and Volgenant 1987),
/// O(rows^2 (rows + columns)).
[[nodiscard]] std::vector<int> assign(const Eigen::MatrixXd& cost, double limit);

}  // namespace sarn_perception
