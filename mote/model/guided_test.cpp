#include "mote/model/guided.hpp"

#include "mote/model/bearings.hpp"
#include "mote/model/doa.hpp"
#include "mote/model/laws.hpp"
#include "mote/model/local_level.hpp"

namespace mote {
namespace {

static_assert(HasNoise<Bearings> && HasNoise<Doa> && HasNoise<LocalLevel>);

using Observed = std::vector<Row<double>>;

/// A target that manoeuvres much within a step, seen sharply: what the guide is for.
Bearings manoeuvring(double dof = 0, double distortion = 0) {
  Bearings model;
  model.p.sigma_u = 0.5;
  model.p.sigma_r = 0.01;
  model.p.dof = dof;
  model.p.distortion = distortion;
  return model;
}
const std::array<double, 4> kBefore{3, 0.2, 2, -0.1};

/// What one or two sensors see of the state that the noise (0.8, -1.1) leads to.
Observed seen(const Bearings& model, bool both) {
  const auto x = model.moved<double>(kBefore, 0.8 * model.p.sigma_u, -1.1 * model.p.sigma_u);
  Observed rows;
  for (const std::array<double, 3> sensor : {std::array{0.0, 0.0, 0.3}, std::array{5.0, 0.0, 1.5}}) {
    if (!both && !rows.empty()) break;
    auto row = Row<double>::of({0, sensor[0], sensor[1], sensor[2]});
    row.values[0] = -model.error(x, row);
    rows.push_back(row);
  }
  return rows;
}

// referee  the optimal proposal, which is exact: in a linear model the guide is nine tenths of it
TEST(Guided, IsTheOptimalProposalAndATenthOfThePriorWhereTheModelIsLinear) {
  const LocalLevel model;
  const Observed y{Row<double>::of({1000}), Row<double>::of({1210})};
  for (const double x : {700.0, 1050.0, 1300.0}) {
    const double prior = std::exp(model.log_transition<double>(1, {x}, {1120}));
    const double optimal = std::exp(LocalLevelOptimal{}.log_density<double>(model, 1, {x}, {1120}, y));
    EXPECT_NEAR(Guided{}.log_density<double>(model, 1, std::array<double, 1>{x}, std::array<double, 1>{1120}, y),
                std::log(0.1 * prior + 0.9 * optimal), 1e-9)
        << x;
  }
}

TEST(Guided, IsThePriorWithoutAnObservation) {
  const Bearings model = manoeuvring();
  const Observed blank{blank_row(model)};
  const auto x = model.moved<double>(kBefore, 0.4, -0.2);
  for (const Observed& none : {Observed{}, blank})
    EXPECT_NEAR(Guided{}.log_density<double>(model, 1, x, kBefore, none), model.log_transition<double>(1, x, kBefore),
                1e-12);
}

TEST(Guided, NoiseLeadsFromTheOneStateToTheOther) {
  auto block = Draws{31, 0}.block(Purpose::kTest);
  auto source = block.particle(0);
  const auto check = [&](const auto& model) {
    const auto before = model.template initial<double>(source);
    auto draw = laws::listed(source);
    const auto x = model.template next<double>(3, before, draw);
    const auto u = model.template noise<double>(3, x, before);
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], draw.normals[i], 1e-6) << i;
  };
  check(Bearings{});
  check(Doa{});
  check(LocalLevel{});
}

/// The mass of the guide's density over the accelerations, by the midpoint rule within eight standard deviations.
double mass(const Bearings& model, const Observed& y) {
  const double h = 0.02;
  double sum = 0;
  for (double u = -8 + h / 2; u < 8; u += h)
    for (double v = -8 + h / 2; v < 8; v += h)
      sum += std::exp(Guided{}.log_density<double>(
          model, 1, model.moved<double>(kBefore, u * model.p.sigma_u, v * model.p.sigma_u), kBefore, y));
  return sum * h * h * model.p.sigma_u * model.p.sigma_u;
}

// referee  quadrature over both accelerations: the density integrates to one, whatever the errors and the sensors
TEST(Guided, DensityIntegratesToOne) {
  EXPECT_NEAR(mass(manoeuvring(), seen(manoeuvring(), false)), 1, 1e-3);
  EXPECT_NEAR(mass(manoeuvring(3, 0.3), seen(manoeuvring(3, 0.3), true)), 1, 1e-3);
}

/// z score of E_g[p(x | before) / g(x | before, y)] = 1, the ratio raised to a power.
template <class M>
double ratio_z(const M& model, const StateOf<M, double>& before, const Observed& y, double power) {
  auto block = Draws{32, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  return laws::z_of_mean_one(20000, [&] {
    const auto x = Guided{}.propose<double>(model, 1, before, y, draw);
    return std::exp(power * (model.template log_transition<double>(1, x, before) -
                             Guided{}.log_density<double>(model, 1, x, before, y)));
  });
}

// claim    log_density is the density of propose(), in the space of the model's transition density
// referee  E_g[p / g] = 1: the defensive part keeps the ratio below 10
// design   20 000 draws, one fixed seed; an observation 1.4 standard deviations of the noise away
// risk     1e-6 (|z| < 4.89); the twin, the ratio raised to the power 0.7, must fail
TEST(Guided, HasTheDensityOfItsDraws) {
  const auto check = [](const auto& model, const auto& before, const Observed& y) {
    EXPECT_LT(std::abs(ratio_z(model, before, y, 1)), 4.89);
    EXPECT_GT(std::abs(ratio_z(model, before, y, 0.7)), 4.89) << "the twin";
  };
  check(manoeuvring(), kBefore, seen(manoeuvring(), false));
  check(manoeuvring(), kBefore, seen(manoeuvring(), true));
  check(manoeuvring(3, 0.3), kBefore, seen(manoeuvring(3, 0.3), true));
  Doa doa;
  doa.frame = 3;
  doa.p.sigma_theta = 0.3;
  doa.p.correlation = 0.5;
  doa.p.dof = 4;
  check(doa, std::array<double, 3>{2.5, 0.1, 0.4}, {Row<double>::of({2.8, 2.85, 2.9})});
  check(LocalLevel{}, std::array<double, 1>{1120}, {Row<double>::of({900})});
}

}  // namespace
}  // namespace mote
