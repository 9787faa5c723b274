#include "mote/hardware/machine/simulator.hpp"

#include <algorithm>

#include <dlfcn.h>

#include "mote/base/refusal.hpp"
#include "mote/hardware/machine/bits.hpp"
#include "mote/hardware/machine/driver/request.hpp"
#include "mote/hardware/machine/templates.hpp"
#include "mote/hardware/tools.hpp"

namespace mote::hardware {
namespace {

/// The driver's header that knows the circuit's registers.
std::string registers_header(const Machine& machine) {
  const auto& registers = machine.architecture().registers;
  if (machine.access() == RegisterAccess::kAxiLite)
    return "#pragma once\ninline constexpr unsigned kRegisters = " + std::to_string(registers.size()) +
           ", kAddressBits = " + std::to_string(machine.address_bits()) + ";\n#include \"axi_lite.hpp\"\n";
  std::string text = "#pragma once\n\ntemplate <class Top, class Each>\nvoid for_registers(Top& top, Each each) {\n";
  for (const Register& one : registers) text += "  each(top." + std::string(one.name) + "_i);\n";
  return text + "}\n#include \"ports.hpp\"\n";
}

/// Takes down what the driver notes.
struct Notes {
  const Machine* machine;
  std::size_t particles;
  CircuitRun* run;
  std::size_t written = 0;

  /// A write holds a slot's particle of every lane; the golden model's sets have them side by side.
  void kept(const std::uint32_t* words) {
    const Formats& f = machine->formats();
    const Capacity& capacity = machine->capacity();
    const auto slot_bits = static_cast<int>(capacity.slot_bits());
    const auto slot = BitReader(words + 1).take(slot_bits);
    BitReader state(words + 1 + words_of(slot_bits));
    if (written % particles == 0) run->sets.emplace_back(f.dims, std::vector<std::int64_t>(particles));
    written += capacity.lanes;
    for (unsigned lane = 0; lane < capacity.lanes; ++lane)
      for (unsigned d = 0; d < f.dims; ++d)
        run->sets.back()[d].at(slot * capacity.lanes + lane) = state.take_signed(static_cast<int>(f.value_bits));
  }
  void estimated(const std::uint32_t* words) { run->estimates.push_back(machine->estimate_in(words)); }
};

std::uint64_t differing(const Particles& a, const Particles& b) {
  std::uint64_t count = 0;
  for (std::size_t d = 0; d < a.size(); ++d)
    for (std::size_t i = 0; i < a[d].size(); ++i) count += a[d][i] != b[d][i];
  return count;
}

}  // namespace

Simulator::Simulator(const Machine& machine, bool counts_changes)
    : machine_(&machine), counts_changes_(counts_changes) {
  build();
}

Simulator::~Simulator() {
  if (library_ == nullptr) return;
  reinterpret_cast<void (*)(void*)>(dlsym(library_, "driver_close"))(driver_);
  dlclose(library_);
}

void Simulator::build() {
  const std::string folder = folder_.path().string() + "/";
  for (const DesignFile& file : machine_->modules(folder)) write_text(folder + file.name, file.text);
  for (const DesignFile& file : machine_->tables()) write_text(folder + file.name, file.text);
  for (const char* name : {"driver.cpp", "request.hpp", "ports.hpp", "axi_lite.hpp"})
    write_text(folder + name, std::string(machine_template(name)));
  write_text(folder + "registers.hpp", registers_header(*machine_));
  std::string make = counts_changes_ ? "OPT_FAST=-O0" : "OPT_FAST=-O1";
  make += " OPT_SLOW=-O0 OPT_GLOBAL=-O1";
  if (on_path("ccache")) make += " OBJCACHE=ccache";
  std::vector<std::string> words{"--cc", "--exe", "--build", "-Wall", "-O3", "--assert", "--x-assign", "fast"};
  if (counts_changes_) words.insert(words.end(), {"--coverage-toggle", "--coverage-max-width", "4096"});
  words.insert(words.end(), {"--top-module", machine_->top_name(), "--prefix", "Vtop", "--Mdir", folder + "model", "-y",
                             folder, "-CFLAGS", "-fPIC", "-LDFLAGS", "-shared", "-MAKEFLAGS", make, "-o", "circuit.so",
                             folder + machine_->top_name() + ".sv", folder + "driver.cpp"});
  run_tool("verilator", "verilator", words);
  library_ = dlopen((folder + "model/circuit.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr)
    throw Refusal(ExitCode::kOutsideTool, {"verilator", "", "a library that loads", dlerror(), "Reinstall verilator."});
  driver_ = reinterpret_cast<void* (*)()>(dlsym(library_, "driver_open"))();
}

void Simulator::reset() { reinterpret_cast<void (*)(void*)>(dlsym(library_, "driver_reset"))(driver_); }

CircuitRun Simulator::run(const RunRegisters& registers, const std::vector<std::vector<std::int64_t>>& observed,
                          StreamPauses pauses, std::uint64_t most_cycles) {
  std::vector<std::uint32_t> register_words, observations;
  for (const Register& one : machine_->architecture().registers) register_words.push_back(one.value(registers));
  for (const auto& values : observed) {
    const auto words = machine_->observation_words(values);
    observations.insert(observations.end(), words.begin(), words.end());
  }
  CircuitRun run;
  Notes notes{machine_, registers.particles, &run};
  const Request request{register_words.data(),
                        observations.data(),
                        static_cast<std::uint32_t>(words_of(machine_->observation_bits())),
                        static_cast<std::uint32_t>(observed.size()),
                        pauses.observations,
                        pauses.estimates,
                        pauses.seed,
                        most_cycles,
                        &notes,
                        [](void* self, const std::uint32_t* words) { static_cast<Notes*>(self)->kept(words); },
                        [](void* self, const std::uint32_t* words) { static_cast<Notes*>(self)->estimated(words); },
                        [](void* self) { static_cast<Notes*>(self)->run->answered_wrong = true; }};
  using Run = std::uint64_t (*)(void*, const Request*);
  run.cycles = reinterpret_cast<Run>(dlsym(library_, "driver_run"))(driver_, &request);
  if (counts_changes_) {
    const std::string file = (folder_.path() / "changes.txt").string();
    reinterpret_cast<void (*)(void*, const char*)>(dlsym(library_, "driver_write_changes"))(driver_, file.c_str());
    run.activity = activity_of(read_text(file), run.cycles);
  }
  run.complete = run.estimates.size() == observed.size();
  return run;
}

Agreement agreement(const CircuitRun& run, Golden& golden, const RunRegisters& registers,
                    const std::vector<std::vector<std::int64_t>>& observed) {
  Agreement found;
  golden.start(registers);
  for (std::size_t k = 0; k < observed.size(); ++k) {
    const Estimate estimate = golden.step(observed[k]);
    const std::uint64_t words = golden.set().size() * registers.particles;
    found.compared += words;
    found.mismatches += k < run.sets.size() ? differing(golden.set(), run.sets[k]) : words;
    found.mismatches += k >= run.estimates.size() || run.estimates[k] != estimate;
  }
  found.mismatches += run.answered_wrong;
  found.cycles = run.cycles;
  found.predicted_cycles = golden.cycles();
  return found;
}

}  // namespace mote::hardware
