// SPDX-License-Identifier: BSD-3-Clause
// Drives the fuzz target without libFuzzer, for compilers that do not have it: random inputs and mutations of
// earlier ones for a given time. An input that ends the program is left in a file, which plays it again.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr const char* kUsage =
    "usage: lattice_planner_fuzz_run [--seconds S] [--seed N]    S seconds of random inputs (60)\n"
    "       lattice_planner_fuzz_run FILE...                     these inputs\n";
constexpr const char* kCrashFile = "lattice_planner_fuzz_crash";
constexpr std::size_t kLongest = 600;  // [bytes]
constexpr std::size_t kKept = 512;     // inputs to mutate

std::vector<std::uint8_t> input;  // the present one

void leaveInput(int signal_number) {
  const int file = open(kCrashFile, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0) {
    (void)!write(file, input.data(), input.size());
    (void)close(file);
  }
  std::signal(signal_number, SIG_DFL);
  (void)std::raise(signal_number);
}

void mutate(std::mt19937& random, const std::vector<std::vector<std::uint8_t>>& kept) {
  const bool fresh = kept.empty() || random() % 4 == 0;
  if (fresh) {
    input.resize(random() % kLongest);
    for (auto& byte : input) byte = static_cast<std::uint8_t>(random());
    return;
  }
  input = kept[random() % kept.size()];
  for (unsigned i = 0; i < 1 + random() % 8 && !input.empty(); ++i) {
    const std::size_t at = random() % input.size();
    const std::uint8_t special[] = {0, 1, 127, 128, 253, 254, 255};
    switch (random() % 4) {
      case 0:
        input[at] = static_cast<std::uint8_t>(input[at] ^ (1U << (random() % 8)));
        break;
      case 1:
        input[at] = special[random() % std::size(special)];
        break;
      case 2:
        input.resize(std::min(kLongest, at + random() % 64), static_cast<std::uint8_t>(random()));
        break;
      default: {
        const auto& other = kept[random() % kept.size()];
        for (std::size_t k = at; k < input.size() && k < other.size(); ++k) input[k] = other[k];
      }
    }
  }
}

int fuzz(double seconds, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::vector<std::uint8_t>> kept;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  long count = 0;
  for (; std::chrono::steady_clock::now() < end; ++count) {
    mutate(random, kept);
    (void)LLVMFuzzerTestOneInput(input.data(), input.size());
    if (kept.size() < kKept) {
      kept.push_back(input);
    } else if (random() % 16 == 0) {
      kept[random() % kKept] = input;
    }
  }
  std::printf("%ld inputs in %.0f s, seed %u: no fault\n", count, seconds, seed);
  return count > 0 ? 0 : 1;
}

int play(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
    return 2;
  }
  input.assign(std::istreambuf_iterator<char>(in), {});
  (void)LLVMFuzzerTestOneInput(input.data(), input.size());
  std::printf("%s: no fault\n", file.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  for (const int number : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL}) std::signal(number, leaveInput);
  double seconds = 60.0;
  unsigned seed = 1;
  int status = 0;
  bool played = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--seconds") == 0 && i + 1 < argc) {
      seconds = std::atof(argv[++i]);
    } else if (std::strcmp(argv[i], "--seed") == 0 && i + 1 < argc) {
      seed = static_cast<unsigned>(std::atoi(argv[++i]));
    } else if (argv[i][0] == '-') {
      std::fputs(kUsage, stderr);
      return 2;
    } else {
      status = std::max(status, play(argv[i]));
      played = true;
    }
  }
  return played ? status : fuzz(seconds, seed);
}
