// SPDX-License-Identifier: BSD-3-Clause
// What the README says of the parameters is what they are.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "lattice_planner/planner_params.h"
#include "sarn_common/parameters.h"

namespace lattice_planner {
namespace {

struct Row {
  std::string value;
  std::string range;
};

/// Rows "| `name` | default | range | meaning |" of the section "## Parameters".
std::map<std::string, Row> table() {
  std::map<std::string, Row> rows;
  std::ifstream in("README.md");
  bool parameters = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("## ", 0) == 0) parameters = line == "## Parameters";
    if (!parameters || line.rfind("| `", 0) != 0) continue;
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, '|');) {
      const auto first = cell.find_first_not_of(" `");
      const auto last = cell.find_last_not_of(" `");
      cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    }
    if (cells.size() >= 4) rows[cells[1]] = {cells[2], cells[3]};
  }
  return rows;
}

struct Compare {
  const std::map<std::string, Row>& rows;
  template <class T>
  void operator()(const char* key, const T& value, const sarn::Range& range = {}) {
    const auto row = rows.find(key);
    if (row == rows.end()) return;
    if constexpr (std::is_same_v<T, bool>) {
      EXPECT_EQ(row->second.value, value ? "true" : "false") << key;
    } else if constexpr (std::is_arithmetic_v<T>) {
      EXPECT_DOUBLE_EQ(std::atof(row->second.value.c_str()), static_cast<double>(value)) << key;
      double low = 0.0;
      double high = 0.0;
      char comma = 0;
      std::istringstream(row->second.range) >> low >> comma >> high;
      EXPECT_DOUBLE_EQ(low, range.min) << key;
      EXPECT_DOUBLE_EQ(high, range.max) << key;
    } else {
      EXPECT_EQ(row->second.value, "\"" + value + "\"") << key;
    }
  }
};

TEST(Readme, tableIsThatOfTheParameters) {
  const auto rows = table();
  std::vector<std::string> names = sarn::fieldNames<PlannerParams>();
  for (const std::string& name : names) EXPECT_EQ(rows.count(name), 1U) << name << " is missing";
  EXPECT_EQ(rows.size(), names.size());
  Compare compare{rows};
  const PlannerParams defaults;
  PlannerParams::visit(defaults, compare);
}

}  // namespace
}  // namespace lattice_planner
