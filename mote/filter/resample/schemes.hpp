#pragma once
/// Resampling schemes: which particles survive, and how often.
///
/// Every scheme draws N_out ancestors from N weights with mean offspring N_out w_i / sum w (Metropolis: to a stated
/// bias), never one of weight zero. They differ in variance, order and whether they need the sum of the weights. See
/// docs/resampling.md.

#include <cstdint>
#include <span>
#include <string_view>

#include "mote/base/draws.hpp"

namespace mote {

/// Draws ancestors[j], j < N_out, from the weights.
///
/// shape   weights: (N,), finite, >= 0, not all zero, need not sum to one; ancestors: (N_out,), N_out >= 1
using ResampleFunction = void (*)(std::span<const double> weights, const Draws& draws,
                                  std::span<std::uint32_t> ancestors);

/// One scheme of the catalogue.
struct Scheme {
  std::string_view name;
  ResampleFunction resample;
  std::string_view meaning;
};

/// The catalogue of schemes: a new scheme is one line in schemes.cpp.
std::span<const Scheme> schemes();
/// The scheme of that name, or nullptr.
const Scheme* find_scheme(std::string_view name);
/// The papers' choice.
const Scheme& systematic_scheme();

void systematic(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);
void stratified(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);
void multinomial(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);
void roulette(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);
void residual(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);
void alias(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);
void metropolis(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);
void rejection(std::span<const double> weights, const Draws& draws, std::span<std::uint32_t> ancestors);

}  // namespace mote
