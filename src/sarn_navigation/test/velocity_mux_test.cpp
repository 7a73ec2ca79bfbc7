// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/velocity_mux.h"

#include <gtest/gtest.h>

namespace sarn_navigation {
namespace {

constexpr std::size_t kSafety = 0;
constexpr std::size_t kTeleop = 1;
constexpr std::size_t kNavi = 2;

VelocityMux makeMux() {
  return VelocityMux({{"safety", "input/safety", 0.2, 10, ""},
                      {"teleop", "input/teleop", 1.0, 7, ""},
                      {"navi", "input/navi", 1.0, 5, ""},
                      {"other", "input/other", 1.0, 5, ""}});
}

std::string problemOf(const std::string& text) {
  try {
    (void)parseMuxConfig(text, "here.yaml");
  } catch (const MuxConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(VelocityMux, startsIdle) {
  EXPECT_EQ(makeMux().activeName(), "idle");
  EXPECT_FALSE(makeMux().holder());
}

TEST(VelocityMux, passesTheFirstSourceAndItsFurtherCommands) {
  VelocityMux mux = makeMux();
  EXPECT_TRUE(mux.offer(kNavi, 1.0));
  EXPECT_TRUE(mux.offer(kNavi, 1.5));
  EXPECT_EQ(mux.activeName(), "navi");
}

TEST(VelocityMux, handsOverToHigherPriorityAndBlocksLower) {
  VelocityMux mux = makeMux();
  EXPECT_TRUE(mux.offer(kNavi, 1.0));
  EXPECT_TRUE(mux.offer(kTeleop, 1.1));
  EXPECT_FALSE(mux.offer(kNavi, 1.2));
  EXPECT_TRUE(mux.offer(kSafety, 1.3));
  EXPECT_EQ(mux.activeName(), "safety");
}

TEST(VelocityMux, equalPriorityDoesNotTakeOver) {
  VelocityMux mux = makeMux();
  EXPECT_TRUE(mux.offer(kNavi, 1.0));
  EXPECT_FALSE(mux.offer(3, 1.1));
}

TEST(VelocityMux, releasesAfterTheHoldersOwnTimeout) {
  VelocityMux mux = makeMux();
  EXPECT_TRUE(mux.offer(kSafety, 1.0));
  EXPECT_FALSE(mux.offer(kNavi, 1.19));
  EXPECT_TRUE(mux.offer(kNavi, 1.21));
  mux.expire(2.2);
  EXPECT_EQ(mux.activeName(), "navi");
  mux.expire(2.22);
  EXPECT_EQ(mux.activeName(), "idle");
}

TEST(VelocityMux, blockedCommandsDoNotProlongTheHolder) {
  VelocityMux mux = makeMux();
  EXPECT_TRUE(mux.offer(kTeleop, 1.0));
  for (double t = 1.1; t < 1.95; t += 0.1) EXPECT_FALSE(mux.offer(kNavi, t));
  EXPECT_TRUE(mux.offer(kNavi, 2.05));
}

TEST(VelocityMux, aClockThatJumpsBackReleases) {
  VelocityMux mux = makeMux();
  EXPECT_TRUE(mux.offer(kSafety, 100.0));
  EXPECT_TRUE(mux.offer(kNavi, 3.0));
  EXPECT_EQ(mux.activeName(), "navi");
}

TEST(VelocityMux, refusesTwoInputsOfOneTopic) {
  EXPECT_THROW(VelocityMux({{"a", "t", 1.0, 1, ""}, {"b", "t", 1.0, 2, ""}}), std::invalid_argument);
  EXPECT_THROW(VelocityMux({{"a", "t", 0.0, 1, ""}}), std::invalid_argument);
}

TEST(MuxConfig, shippedFileIsTheTurtlebotTable) {
  const MuxConfig config = loadMuxConfig("config/mux.yaml");
  ASSERT_EQ(config.inputs.size(), 4U);
  const struct {
    const char* topic;
    double timeout;
    int priority;
  } expected[] = {{"input/safety_controller", 0.2, 10},
                  {"input/teleop", 1.0, 7},
                  {"input/switch", 1.0, 6},
                  {"input/navi", 1.0, 5}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(config.inputs[i].topic, expected[i].topic);
    EXPECT_DOUBLE_EQ(config.inputs[i].timeout, expected[i].timeout);
    EXPECT_EQ(config.inputs[i].priority, expected[i].priority);
  }
  EXPECT_EQ(config.inputs[3].name, "Navigation");
  EXPECT_EQ(config.publisher, "output");
}

TEST(MuxConfig, namesSourceEntryAndKeyOfEveryProblem) {
  const std::string problem = problemOf(
      "subscribers:\n  - {name: a, topic: t, timeout: -1, priority: 1}\n  - {name: b, topik: t, priority: "
      "x}\n");
  EXPECT_NE(problem.find("here.yaml"), std::string::npos) << problem;
  EXPECT_NE(problem.find("subscribers[0].timeout"), std::string::npos) << problem;
  EXPECT_NE(problem.find("subscribers[1].topik: unknown key"), std::string::npos) << problem;
  EXPECT_NE(problem.find("subscribers[1].priority"), std::string::npos) << problem;
  EXPECT_NE(problem.find("subscribers[1].timeout: missing"), std::string::npos) << problem;
  EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
}

TEST(MuxConfig, refusesWhatIsNotAList) {
  EXPECT_NE(problemOf("subscribers: []"), "");
  EXPECT_NE(problemOf("hello"), "");
  EXPECT_NE(problemOf("subscribers: [1]"), "");
  EXPECT_NE(problemOf("subscribers: [{name: a, topic: t, timeout: 1, priority: 1}]\npublisher: [1]"), "");
  EXPECT_NE(problemOf("a: [").find("line"), std::string::npos);
  EXPECT_THROW((void)loadMuxConfig("config/no_such_file.yaml"), MuxConfigError);
  EXPECT_THROW((void)loadMuxConfig("config"), MuxConfigError);
}

}  // namespace
}  // namespace sarn_navigation
