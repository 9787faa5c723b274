#include "mote/model/local_level.hpp"

#include "mote/model/laws.hpp"

namespace mote {
namespace {

MOTE_MODEL_LAWS(LocalLevel, LocalLevel{})

TEST(LocalLevel, OptimalProposalIsBayesRule) {
  const LocalLevel model;
  const std::vector<Row<double>> y{Row<double>::of({1000}), Row<double>::of({1300})};
  const LocalLevelOptimal optimal;
  // p(y | x) p(x | x') / g(x | x', y) is the same for every x
  const auto log_weight = [&](double x) {
    double sum = model.log_transition<double>(1, {x}, {1100}) - optimal.log_density<double>(model, 1, {x}, {1100}, y);
    for (const auto& row : y) sum += model.log_likelihood<double>(1, {x}, row);
    return sum;
  };
  for (const double x : {900.0, 1100.0, 1234.0}) EXPECT_NEAR(log_weight(x), log_weight(1000), 1e-9);
}

}  // namespace
}  // namespace mote
