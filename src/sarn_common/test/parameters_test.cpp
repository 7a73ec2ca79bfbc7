// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/parameters.h"

#include <gtest/gtest.h>

namespace sarn {
namespace {

struct Sample {
  double speed = 0.5;
  int steps = 3;
  bool active = true;
  std::string frame = "map";

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("speed", p.speed, {0.0, 2.0});
    v("steps", p.steps, {1.0, 10.0});
    v("active", p.active);
    v("frame", p.frame);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    return frame.empty() ? std::vector<std::string>{"frame: must not be empty"} : std::vector<std::string>{};
  }
};

TEST(Parameters, listsFieldsInOrder) {
  EXPECT_EQ(fieldNames<Sample>(), (std::vector<std::string>{"speed", "steps", "active", "frame"}));
}

TEST(Parameters, namesEveryProblemAtOnce) {
  Sample sample;
  EXPECT_TRUE(problems(sample).empty());
  sample.speed = -1.0;
  sample.steps = 11;
  sample.frame.clear();
  EXPECT_EQ(problems(sample).size(), 3U);
  EXPECT_EQ(problems(sample)[0], "speed: -1 is outside [0, 2]");
}

TEST(Parameters, refusesNan) {
  Sample sample;
  sample.speed = std::nan("");
  EXPECT_EQ(problems(sample).size(), 1U);
}

TEST(Parameters, readsYamlAndRefusesUnknownKeys) {
  Sample sample;
  EXPECT_TRUE(setFromYaml(YAML::Load("{speed: 1.5, active: false}"), sample).empty());
  EXPECT_DOUBLE_EQ(sample.speed, 1.5);
  EXPECT_FALSE(sample.active);
  EXPECT_EQ(setFromYaml(YAML::Load("{sped: 1.5}"), sample).front(), "sped: unknown key");
  EXPECT_EQ(setFromYaml(YAML::Load("{steps: many}"), sample).size(), 1U);
}

TEST(Parameters, takesAListForAStringAsItsText) {
  Sample sample;
  EXPECT_TRUE(setFromYaml(YAML::Load("frame: [[0.5, 1], [-2, 0.25]]"), sample).empty());
  EXPECT_EQ(sample.frame, "[[0.5, 1], [-2, 0.25]]");
  EXPECT_TRUE(setFromYaml(YAML::Load("frame:\n  - [0.5, 1]\n  - [-2, 0.25]"), sample).empty());
  EXPECT_EQ(YAML::Load(sample.frame)[1][0].as<double>(), -2.0);
}

}  // namespace
}  // namespace sarn
