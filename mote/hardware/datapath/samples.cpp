#include "mote/hardware/datapath/samples.hpp"

#include <algorithm>

namespace mote::hardware {

SampledArithmetic::SampledArithmetic(const graph::Recorded& recorded, std::size_t stride, std::size_t most)
    : values_(recorded.graph.size()), stride_(stride), most_(most) {
  const auto last = [](const std::vector<graph::Id>& outputs) {
    return *std::max_element(outputs.begin(), outputs.end());  // operands come before what uses them
  };
  last_ = {last(recorded.initial), last(recorded.next), recorded.log_likelihood};
}

void SampledArithmetic::end_of(std::size_t part) {
  if (count_[part]++ % stride_ == 0 && samples_.calls[part].size() < most_) samples_.calls[part].push_back(values_);
}

}  // namespace mote::hardware
