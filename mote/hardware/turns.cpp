#include "mote/hardware/turns.hpp"

#include <algorithm>
#include <cstdlib>

namespace mote::hardware {
namespace {

bool same_parameters(const Circuit& a, const Circuit& b) {
  return std::equal(a.parameters.begin(), a.parameters.end(), b.parameters.begin(), b.parameters.end(),
                    [](const Parameter& x, const Parameter& y) { return x.name == y.name && x.value == y.value; });
}

bool same_tables(const Circuit& a, const Circuit& b) {
  return std::equal(a.memories.begin(), a.memories.end(), b.memories.begin(), b.memories.end(),
                    [](const Memory& x, const Memory& y) { return x.width == y.width && x.words == y.words; });
}

/// Can one instance stand for both?
bool of_one_kind(const Circuit& a, const Circuit& b) {
  if (a.module != b.module || a.latency != b.latency || a.sharing != b.sharing) return false;
  return a.sharing == Sharing::kWidened || (same_parameters(a, b) && same_tables(a, b));
}

void widen(std::vector<Port>& ports, const std::vector<Port>& by) {
  for (std::size_t p = 0; p < ports.size(); ++p) ports[p].width = std::max(ports[p].width, by[p].width);
}

void widen(Circuit& circuit, const Circuit& by) {
  widen(circuit.inputs, by.inputs);
  widen(circuit.outputs, by.outputs);
  for (std::size_t k = 0; k < circuit.parameters.size(); ++k) {
    std::string& value = circuit.parameters[k].value;
    const std::string& other = by.parameters[k].value;
    if (value != other) value = std::to_string(std::max(std::stoi(value), std::stoi(other)));
  }
}

/// By how much two circuits of a kind differ, in bits of operands.
int bits_more(const Circuit& a, const Circuit& b) {
  int bits = 0;
  for (std::size_t p = 0; p < a.inputs.size(); ++p) bits += std::abs(a.inputs[p].width - b.inputs[p].width);
  return bits;
}

}  // namespace

std::size_t Turns::Instance::takers() const {
  return taker.size() - static_cast<std::size_t>(std::count(taker.begin(), taker.end(), kNobody));
}

bool Turns::any() const {
  return std::any_of(instances_.begin(), instances_.end(), [](const Instance& one) { return one.takers() > 1; });
}

int Turns::take(std::size_t taker, const Circuit& circuit, int ready) {
  if (circuit.sharing == Sharing::kNever || interval_ == 1) return ready;
  const int first = std::max(ready, 1);
  for (int start = first; start < first + interval_; ++start) {
    const auto phase = static_cast<std::size_t>(start % interval_);
    Instance* best = nullptr;
    for (Instance& one : instances_)
      if (one.taker[phase] == Instance::kNobody && of_one_kind(one.circuit, circuit) &&
          (best == nullptr || bits_more(one.circuit, circuit) < bits_more(best->circuit, circuit)))
        best = &one;
    if (best == nullptr) continue;
    best->taker[phase] = taker;
    widen(best->circuit, circuit);
    return start;
  }
  Instance& one = instances_.emplace_back(circuit, std::vector(static_cast<std::size_t>(interval_), Instance::kNobody));
  one.taker[static_cast<std::size_t>(first % interval_)] = taker;
  return first;
}

}  // namespace mote::hardware
