#include "mote/model/ungm.hpp"

#include "mote/model/laws.hpp"

namespace mote {
namespace {

MOTE_MODEL_LAWS(Ungm, Ungm<1>{})
MOTE_MODEL_LAWS(UngmTwoCopies, Ungm<2>{})
MOTE_MODEL_LAWS(UngmOfTheSecondPaper, Ungm<1>{{1, 2, 10, 1, 5}})

TEST(Ungm, FollowsThePrintedEquations) {
  const Ungm<1> model;
  EXPECT_DOUBLE_EQ(model.drift(1, 2.0), 0.5 * 2 + 25 * 2 / 5.0 + 8);
  EXPECT_DOUBLE_EQ(model.drift(4, 0.0), 8 * std::cos(1.2 * 3));
  EXPECT_DOUBLE_EQ((model.log_likelihood<double>(1, {10.0}, Row<double>::of({7.0}))),
                   -0.5 * 4 - 0.5 * std::log(2 * kPi));
}

/// z score of E_g[ p(x | b) / g(x | b, y) ] = 1: a proposal's density is the density of its draws, and it covers the
/// transition.
template <class G>
double proposal_z(const G& proposal, double power, const std::vector<Row<double>>& y) {
  const Ungm<2> model;
  auto block = Draws{21, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  const std::array<double, 2> before{0.3, -4.0};
  // importance identity with a narrow density q inside g's support
  const Ungm<2> narrow{{0.5, 1.2, 4, 1, 5}};
  return laws::z_of_mean_one(60000, [&] {
    const auto x = proposal.template propose<double>(model, 6, before, y, draw);
    return std::exp(power * (narrow.log_transition<double>(6, x, before) -
                             proposal.template log_density<double>(model, 6, x, before, y)));
  });
}

// claim    log_density is the density of propose()
// referee  E_g[q / g] = 1 for any density q that g covers
// risk     1e-6 (|z| < 4.89); the twin, the ratio raised to the power 0.7, must fail
TEST(UngmProposals, HaveTheDensityOfTheirDraws) {
  const std::vector<Row<double>> near_zero{Row<double>::of({0.05, 0.02})};
  const std::vector<Row<double>> usual{Row<double>::of({3.0, 6.0})};
  const std::vector<Row<double>> half_missing{{{3.0, kNaN}, {true, false}}};
  for (const auto& y : {near_zero, usual, half_missing}) {
    EXPECT_LT(std::abs(proposal_z(UngmObservation{}, 1.0, y)), 4.89);
    EXPECT_GT(std::abs(proposal_z(UngmObservation{}, 0.7, y)), 4.89);
  }
}

// The printed proposal has variance 1 and does not cover the transition, so q is itself: recovered by quadrature
// instead.
TEST(UngmProposals, ThePrintedOneIntegratesToOne) {
  const Ungm<1> model;
  const std::vector<Row<double>> y{Row<double>::of({3.0})};
  double mass = 0;
  double mean = 0;
  const double h = 1e-3;
  for (double x = -80; x < 80; x += h) {
    const double g = std::exp(UngmObservationSum{}.log_density<double>(model, 6, {x}, {0.3}, y));
    mass += g * h;
    mean += x * g * h;
  }
  EXPECT_NEAR(mass, 1, 1e-9);
  EXPECT_NEAR(mean, model.drift(6, 0.3), 1e-6);
  auto block = Draws{22, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  double sum = 0;
  for (int i = 0; i < 20000; ++i)
    sum += UngmObservationSum{}.propose<double>(model, 6, std::array<double, 1>{0.3}, y, draw)[0];
  EXPECT_NEAR(sum / 20000, mean, 4.89 * std::sqrt((60.0 + 1) / 20000));
  EXPECT_GT(std::abs(sum / 20000 - mean - 1), 4.89 * std::sqrt((60.0 + 1) / 20000))
      << "the twin, a mean off by one, must fail";
}

}  // namespace
}  // namespace mote
