// Drives a filter circuit that Verilator has turned into the class Vtop. Compiled with it when a circuit is simulated;
// registers.hpp is written for the circuit.
#include <random>
#include <vector>

#include "Vtop.h"
#include "registers.hpp"
#include "request.hpp"
#include "verilated.h"
#if VM_COVERAGE
#include "verilated_cov.h"
#endif

namespace {

template <class Port>
void put(Port& port, const std::uint32_t* words) {
  std::uint64_t value = words[0];
  if constexpr (sizeof(Port) > 4) value |= std::uint64_t{words[1]} << 32;
  port = static_cast<Port>(value);
}
template <std::size_t N>
void put(VlWide<N>& port, const std::uint32_t* words) {
  for (std::size_t i = 0; i < N; ++i) port[i] = words[i];
}

template <class Port>
void take(const Port& port, std::vector<std::uint32_t>& words) {
  words.push_back(static_cast<std::uint32_t>(port));
  if constexpr (sizeof(Port) > 4) words.push_back(static_cast<std::uint32_t>(port >> 32));
}
template <std::size_t N>
void take(const VlWide<N>& port, std::vector<std::uint32_t>& words) {
  for (std::size_t i = 0; i < N; ++i) words.push_back(port[i]);
}

class Driver {
 public:
  Driver() : top_(&context_), registers_(top_) { reset(); }
  ~Driver() { top_.final(); }

  void reset() {
    top_.clk_i = 0;
    top_.rst_ni = 0;
    top_.obs_tvalid_i = 0;
    top_.est_tready_i = 0;
    top_.eval();
    tick();
    top_.rst_ni = 1;
    top_.eval();
  }

  /// Cycles from start_i to the last estimate.
  std::uint64_t run(const mote::hardware::Request& request) {
    forget_changes();
    std::mt19937_64 random(request.seed);
    const auto goes = [&](std::uint32_t pause) { return (random() & 255) >= pause; };
    const auto clocks = [this] { tick(); };
    const auto bus_goes = [&] { return goes(request.observation_pause); };
    bool answers = registers_.begin(request, clocks, bus_goes);
    std::uint32_t seen = 0;
    bool offers = false;
    bool done = false;
    std::uint64_t cycles = 0;
    for (; cycles < request.most_cycles && !done; ++cycles) {
      offers = seen < request.steps && (offers || goes(request.observation_pause));
      top_.obs_tvalid_i = offers;
      if (offers) put(top_.obs_tdata_i, request.observations + std::size_t{seen} * request.observation_words);
      top_.est_tready_i = goes(request.estimate_pause);
      answers &= registers_.cycle(cycles);
      top_.eval();
      if (top_.obs_tvalid_i && top_.obs_tready_o) {
        ++seen;
        offers = false;
      }
      if (top_.set_valid_o) note_kept(request);
      const bool leaves = top_.est_tvalid_o && top_.est_tready_i;
      if (leaves) note_estimate(request);
      done = leaves && top_.est_tlast_o;
      tick();
    }
    top_.obs_tvalid_i = 0;
    if (done) answers &= registers_.end(clocks, bus_goes);
    if (!answers) request.answered_wrong(request.self);
    return done ? cycles - 1 : cycles;
  }

  /// Writes how often each bit changed in the last run; nothing where they are not counted.
  void write_changes(const char* file) {
#if VM_COVERAGE
    context_.coveragep()->forcePerInstance(true);
    context_.coveragep()->write(file);
#else
    (void)file;
#endif
  }

 private:
  void forget_changes() {
#if VM_COVERAGE
    context_.coveragep()->zero();
#endif
  }
  void tick() {
    top_.clk_i = 1;
    top_.eval();
    top_.clk_i = 0;
    top_.eval();
  }
  void note_kept(const mote::hardware::Request& request) {
    words_.clear();
    take(top_.set_valid_o, words_);
    take(top_.set_slot_o, words_);
    take(top_.set_state_o, words_);
    request.kept(request.self, words_.data());
  }
  void note_estimate(const mote::hardware::Request& request) {
    words_.clear();
    take(top_.est_tdata_o, words_);
    request.estimated(request.self, words_.data());
  }

  VerilatedContext context_;
  Vtop top_;
  Registers<Vtop> registers_;
  std::vector<std::uint32_t> words_;
};

}  // namespace

extern "C" void* driver_open() { return new Driver; }
extern "C" void driver_close(void* driver) { delete static_cast<Driver*>(driver); }
extern "C" void driver_reset(void* driver) { static_cast<Driver*>(driver)->reset(); }
extern "C" std::uint64_t driver_run(void* driver, const mote::hardware::Request* request) {
  return static_cast<Driver*>(driver)->run(*request);
}
extern "C" void driver_write_changes(void* driver, const char* file) {
  static_cast<Driver*>(driver)->write_changes(file);
}
