#pragma once
/// Runs the program again and again and ends it by a signal each time, until it comes through.

#include <chrono>
#include <random>
#include <thread>

#include "tests/app/program.hpp"

namespace mote::testing {

/// What many endings came to.
struct Survival {
  int ended = 0;   ///< times that the signal ended the program
  int failed = 0;  ///< exit code of an attempt that failed by itself, else 0
  std::string err;
};

/// Repeats the command; the first `times` attempts are ended by `signal` after up to `most` milliseconds, at random.
inline Survival run_and_end(const Scratch& scratch, const std::vector<std::string>& words, int signal, int times,
                            int most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> delay(0, most);
  Survival survival;
  for (int attempt = 0; attempt <= times; ++attempt) {
    Child child(scratch, words);
    if (attempt < times) {
      std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(delay(random)));
      child.signal(signal);
    }
    const auto end = child.end();
    if (end.code == 0) break;
    // 130: the program has seen the signal and ends by itself; before its start is over the signal ends it
    const bool by_signal = end.code == 128 + signal || (signal != SIGKILL && end.code == 130);
    if (by_signal && attempt < times) {
      ++survival.ended;
      continue;
    }
    survival.failed = end.code;
    survival.err = end.err;
    break;
  }
  return survival;
}

}  // namespace mote::testing
