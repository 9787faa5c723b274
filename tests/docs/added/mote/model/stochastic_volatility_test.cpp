#include "mote/model/stochastic_volatility.hpp"

#include "mote/model/laws.hpp"

namespace mote {
namespace {

MOTE_MODEL_LAWS(StochasticVolatility, StochasticVolatility{})

TEST(StochasticVolatility, FollowsItsEquations) {
  const StochasticVolatility model{{-1, 0.5, 0.2, 0.8}};
  EXPECT_DOUBLE_EQ(model.drift(3.0), -1 + 0.5 * 4);
  // a return of one standard deviation: log N(1; 0, 1) less the log of the standard deviation
  EXPECT_DOUBLE_EQ((model.log_likelihood<double>(1, std::array<double, 1>{2.0}, Row<double>::of({std::exp(1.0)}))),
                   -0.5 - 0.5 * std::log(2 * kPi) - 1);
}

}  // namespace
}  // namespace mote
