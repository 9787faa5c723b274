#include "mote/app/simulated/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mote/base/exact_sum.hpp"
#include "mote/design/schedule.hpp"
#include "mote/filter/filter.hpp"
#include "mote/software/pipeline/rank_stages.hpp"
#include "mote/software/share.hpp"
#include "mote/software/simd/block_sums.hpp"

namespace mote::simulated {
namespace {

constexpr double kShortBroadcast = 12288;  // bytes up to which a tree hands all of it on (SMPI's selection "mpich")

/// A message from any host to any other.
struct Network {
  double latency = 0, per_byte = 0;

  double message(double bytes) const { return latency + bytes * per_byte; }
  /// One rank tells all: down a tree, or each a part that all then put together.
  double broadcast(double bytes, std::size_t ranks) const {
    if (ranks < 2) return 0;
    const double rounds = std::ceil(std::log2(static_cast<double>(ranks)));
    if (bytes < kShortBroadcast || ranks < 8) return rounds * message(bytes);
    const double shares = static_cast<double>(ranks - 1) / static_cast<double>(ranks);
    return (rounds + static_cast<double>(ranks) - 1) * latency + 2 * shares * bytes * per_byte;
  }
  /// Each tells all its part of these bytes, by doubled distances.
  double gathered(double bytes, std::size_t ranks) const {
    if (ranks < 2) return 0;
    return std::ceil(std::log2(static_cast<double>(ranks))) * latency +
           bytes * per_byte * static_cast<double>(ranks - 1) / static_cast<double>(ranks);
  }
  /// A sum over all ranks, by doubled distances.
  double summed(double bytes, std::size_t ranks) const {
    return ranks < 2 ? 0 : std::ceil(std::log2(static_cast<double>(ranks))) * message(bytes);
  }
};

std::optional<Network> network_of(const Platform& platform) {
  if (platform.ring || platform.hosts == 0) return std::nullopt;
  return Network{2 * platform.link_latency_s, platform.bandwidth > 0 ? 1 / platform.bandwidth : 0};
}

/// Time of the children that change ranks: at a border in the middle, where most do.
double moving(const Network& net, const Workload& work, double particles) {
  const double variation = std::sqrt(std::max(0.0, 1 / work.ess_share - 1));
  const double children = variation * std::sqrt(particles / (2 * std::numbers::pi));  // mean of |N(0, v^2 N / 4)|
  return net.message(children * static_cast<double>(work.dimensions * work.number_bytes));
}

}  // namespace

std::optional<double> predicted_by_stages(const Platform& platform, const Workload& work, const Cast& cast) {
  const auto net = network_of(platform);
  if (!net) return std::nullopt;
  const bool resamples = work.filter == FilterKind::kSisr;
  const std::size_t block = work.block != 0 ? work.block : message_block(work.particles, cast);
  design::Line line;
  line.n = (work.particles + block - 1) / block;
  const auto n = static_cast<double>(work.particles);
  const double a_block = n / static_cast<double>(line.n);  // the last may be shorter
  const double chain = resamples ? 0 : work.times.chain / static_cast<double>(cast.chains);
  line.times = {work.times.propose * a_block, work.times.weigh * a_block, chain * a_block};
  line.proposers = cast.proposers;
  line.weighers = cast.weighers;
  const auto state = static_cast<double>(work.dimensions * work.number_bytes);
  line.message = {net->latency, net->per_byte, a_block * (state + (resamples ? 8 : 16))};
  const std::size_t ranks = cast.ranks();
  return design::schedule(line).makespan + (resamples ? n * work.times.chain : 0) +
         net->broadcast(sizeof(StepReport), ranks) + net->broadcast(n * (state + (resamples ? 8 : 0)), ranks) +
         (work.step_bytes > 0 ? net->broadcast(static_cast<double>(work.step_bytes), ranks) : 0);
}

std::optional<double> predicted_on_shares(const Platform& platform, const Workload& work, std::size_t ranks) {
  const auto net = network_of(platform);
  if (!net || work.filter != FilterKind::kSisr) return std::nullopt;
  const std::size_t all = work.particles_of(ranks);
  const auto particles = static_cast<double>(all);
  const double working = particles / static_cast<double>(ranks) * seconds_per_particle(work);
  if (ranks < 2) return working;
  const auto dimensions = static_cast<double>(work.dimensions);
  const double sum = sizeof(ExactSum);
  double waiting = moving(*net, work, particles) + static_cast<double>(work.angles) * net->summed(2 * sum, ranks);
  if (BlockSums::tells(all / ranks, all))
    waiting += net->gathered(static_cast<double>(blocks_of(all)) * 3 * (1 + dimensions) * 8, ranks);
  else  // the largest weight, the sums, moments twice, a scan, the places
    waiting += net->summed(8, ranks) + net->summed(2 * sum, ranks) +
               2 * (net->summed(8 * dimensions, ranks) + net->summed(sum * dimensions, ranks)) +
               net->summed(sum, ranks) + net->gathered(4 * static_cast<double>(ranks), ranks);
  return working + waiting;
}

}  // namespace mote::simulated
