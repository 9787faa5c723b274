#pragma once
/// Reads the matrices of a linear Gaussian model.

#include <string>

#include "mote/model/linear_gaussian.hpp"

namespace mote {

/// Reads F, Q, H, R, mean, covariance (and names `states`, `observations`) from a TOML or JSON file.
///
/// A matrix is a list of rows; a 1 x 1 matrix may be a number. `m0` and `P0` are taken for `mean` and `covariance`.
///
/// error   Refusal (kBadData) naming the file and, where known, the line or key
LinearGaussianParameters read_linear_gaussian(const std::string& path);

/// The same from a text; `path` names it and tells JSON (*.json) from TOML.
LinearGaussianParameters parse_linear_gaussian(const std::string& path, const std::string& text);

}  // namespace mote
