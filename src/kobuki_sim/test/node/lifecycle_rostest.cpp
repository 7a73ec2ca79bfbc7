// SPDX-License-Identifier: BSD-3-Clause
// Bad input ends the node with one line and exit code 1; lockstep holds the world; SIGINT ends it cleanly.
#include <rosgraph_msgs/Clock.h>
#include <signal.h>
#include <std_msgs/Time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim_fixture.h"

namespace kobuki_sim {
namespace {

std::string data(const std::string& file) { return ros::param::param<std::string>("~data", "") + "/" + file; }

/// A kobuki_sim of its own in namespace /second, its output in a file.
class SecondSim {
 public:
  explicit SecondSim(const std::vector<std::string>& arguments)
      : output_file_("/tmp/kobuki_sim_lifecycle_" + std::to_string(getpid())) {
    const std::string program =
        (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "kobuki_sim").string();
    std::vector<std::string> words = {program, "__ns:=/second"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      if (freopen(output_file_.c_str(), "w", stdout) == nullptr || dup2(fileno(stdout), fileno(stderr)) < 0) {
        _exit(126);
      }
      execv(program.c_str(), argv.data());
      _exit(127);
    }
  }
  SecondSim(const SecondSim&) = delete;
  SecondSim& operator=(const SecondSim&) = delete;
  ~SecondSim() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    std::remove(output_file_.c_str());
  }

  void interrupt() const { kill(pid_, SIGINT); }
  int awaitExitCode() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string output() const {
    std::stringstream text;
    text << std::ifstream(output_file_).rdbuf();
    return text.str();
  }

 private:
  std::string output_file_;
  pid_t pid_ = -1;
};

void expectRefusal(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
  SecondSim sim(arguments);
  EXPECT_EQ(sim.awaitExitCode(), 1);
  const std::string output = sim.output();
  const std::size_t fatal = output.find("FATAL");
  ASSERT_NE(fatal, std::string::npos) << output;
  EXPECT_EQ(output.find("FATAL", fatal + 1), std::string::npos) << "more than one line:\n" << output;
  const std::string line = output.substr(fatal, output.find('\n', fatal) - fatal);
  for (const auto& word : words)
    EXPECT_NE(line.find(word), std::string::npos) << word << " is not in: " << line;
}

TEST(Lifecycle, refusesToStartWithoutAScenario) { expectRefusal({"__name:=nameless"}, {"scenario", "path"}); }

TEST(Lifecycle, refusesAMissingScenarioNamingIt) {
  expectRefusal({"__name:=missing", "_scenario:=/nowhere/at_all.yaml"}, {"/nowhere/at_all.yaml"});
}

TEST(Lifecycle, refusesAnUnknownKeyNamingFileAndKey) {
  expectRefusal({"__name:=broken", "_scenario:=" + data("broken_scenario.yaml")},
                {"broken_scenario.yaml", "flying_carpets"});
}

TEST(Lifecycle, refusesAMissingMapNamingIt) {
  expectRefusal({"__name:=mapless", "_scenario:=" + data("mapless_scenario.yaml")}, {"nowhere.yaml"});
}

TEST(Lifecycle, refusesAParameterOutOfRangeAndAnUnknownOne) {
  const std::string scenario = "_scenario:=" + data("room_scenario.yaml");
  expectRefusal({"__name:=slow", scenario, "_rate:=-1"}, {"rate", "-1"});
  expectRefusal({"__name:=typo", scenario, "_raet:=1"}, {"raet", "unknown"});
  expectRefusal({"__name:=heavy", scenario, "_base/wheel_radius:=-2"}, {"wheel_radius"});
}

TEST(Lifecycle, endsCleanlyOnInterrupt) {
  SecondSim sim({"__name:=interrupted", "_scenario:=" + data("room_scenario.yaml")});
  ASSERT_TRUE(ros::service::waitForService("/second/kobuki_sim/pause", ros::Duration(-1.0)));
  sim.interrupt();
  EXPECT_EQ(sim.awaitExitCode(), 0) << sim.output();
}

TEST(Lifecycle, waitsForItsLockstepParticipant) {
  ros::param::set("/second/locked/lockstep", std::vector<std::string>{"tester"});
  ros::NodeHandle nh;
  auto acknowledge = nh.advertise<std_msgs::Time>("/second/lockstep/tester", 10);
  const Recorder<rosgraph_msgs::Clock> clock("/second/clock");
  SecondSim sim({"__name:=locked", "_scenario:=" + data("room_scenario.yaml"), "_rate:=0",
                 "_lockstep_slack:=0.1", "_lockstep_timeout:=3600"});
  ASSERT_TRUE(await([&] { return acknowledge.getNumSubscribers() > 0; }));
  // 0.1 s ahead of each acknowledgement, and no further.
  for (int tenth = 0; tenth < 30; ++tenth) {
    const ros::Time acknowledged(0.1 * tenth);
    std_msgs::Time message;
    message.data = acknowledged;
    acknowledge.publish(message);
    const ros::Time limit = acknowledged + ros::Duration(0.1);
    ASSERT_TRUE(await([&] { return !clock.messages.empty() && clock.messages.back().clock >= limit; }))
        << tenth;
    EXPECT_EQ(clock.messages.back().clock, limit);
  }
  sim.interrupt();
  EXPECT_EQ(sim.awaitExitCode(), 0);
}

}  // namespace
}  // namespace kobuki_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "lifecycle_rostest");
  const ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
