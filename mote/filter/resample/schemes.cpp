#include "mote/filter/resample/schemes.hpp"

#include <algorithm>
#include <array>

namespace mote {
namespace {

constexpr std::array<Scheme, 8> kSchemes{{
    {"systematic", systematic, "one uniform, equidistant targets on the cumulative sum"},
    {"stratified", stratified, "one uniform in each of N_out equal strata of the cumulative sum"},
    {"multinomial", multinomial, "independent draws, made in order"},
    {"residual", residual, "floor(N w) copies each, the rest multinomial in the remainders"},
    {"roulette", roulette, "independent draws by inversion of the cumulative sum, one by one"},
    {"alias", alias, "independent draws from Vose's alias table"},
    {"metropolis", metropolis, "short Metropolis chains on the indices; sums the weights only to choose their length"},
    {"rejection", rejection, "uniform candidates accepted with w / w_max; the sum serves only hopeless cases"},
}};

}  // namespace

std::span<const Scheme> schemes() { return kSchemes; }

const Scheme* find_scheme(std::string_view name) {
  const auto* found = std::find_if(kSchemes.begin(), kSchemes.end(), [&](const Scheme& s) { return s.name == name; });
  return found == kSchemes.end() ? nullptr : found;
}

const Scheme& systematic_scheme() { return kSchemes.front(); }

}  // namespace mote
