#pragma once
#include <stdexcept>

#include "mote/app/catalogue/entry.hpp"
#include "mote/app/files/matrices.hpp"
#include "mote/model/linear_gaussian.hpp"

namespace mote {

/// `linear-gaussian`: matrices from the TOML or JSON file given by --set file=...
inline CatalogueEntry linear_gaussian_entry() {
  CatalogueEntry made{"linear-gaussian",
                      "x' = F x + N(0, Q), y = H x + N(0, R), any size; exactly solvable",
                      {},
                      proposals_of<LinearGaussian>(),
                      {},
                      {},
                      nullptr};
  made.parameters.push_back({"file", "", "", "a TOML or JSON file",
                             "matrices F, Q, H, R, vector mean and matrix covariance of x_0; optional lists states and "
                             "observations of names"});
  made.build = [](const std::string& model_name, const Settings& settings, std::span<const std::string>) {
    const auto file = settings.text("file");
    settings.finish(model_name, {"file"});
    if (!file)
      throw Refusal(ExitCode::kWrongUse,
                    {settings.where(), "--set file", "the TOML or JSON file with F, Q, H, R, mean and covariance",
                     "nothing", "Pass --set file=model.toml."});
    try {
      return wrapped(LinearGaussian(read_linear_gaussian(*file)));
    } catch (const std::invalid_argument& wrong) {
      throw Refusal(ExitCode::kBadData,
                    {*file, "", "the matrices of a linear Gaussian model", std::string("others: ") + wrong.what(),
                     "F, Q and covariance are n x n, H is m x n, R is m x m, mean has n numbers."});
    }
  };
  made.example_columns = {"y"};
  made.example_states = {{"x", ""}};
  return made;
}

}  // namespace mote
