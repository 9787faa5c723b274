#include "mote/graph/text/text_model.hpp"

#include <gtest/gtest.h>

#include "mote/graph/record.hpp"
#include "mote/model/bearings.hpp"
#include "mote/model/laws.hpp"
#include "mote/model/ungm.hpp"

namespace mote::graph {
namespace {

const std::string kGrowth = R"toml(name = "growth"
[parameters]
a = 0.5
q = 10.0
r = 1.0
[inputs]
gain = 1.0
[states]
x = "normal(0, sqrt(5))"
[next]
x = "a*x + 25*x/(1 + x^2) + 8*cos(1.2*(t - 1)) + sqrt(q)*normal(0, 1)"
[observations]
y = "normal(gain*x^2/20, sqrt(r))"
)toml";

const std::string kBearings = R"toml([parameters]
sigma_u = 0.001
sigma_r = 0.0488692
[inputs]
sensor_x = 0
sensor_y = 0
sensor_heading = 0
[states]
x = "0.250 + 0.02*normal(0, 1)"
vx = "0.001 + 0.002*normal(0, 1)"
y = "0.240 + 0.02*normal(0, 1)"
vy = "-0.005 + 0.002*normal(0, 1)"
[noise]
ux = "sigma_u*normal(0, 1)"
uy = "sigma_u*normal(0, 1)"
[next]
x = "x + vx + 0.5*ux"
vx = "vx + ux"
y = "y + vy + 0.5*uy"
vy = "vy + uy"
[observations]
bearing = "angle(atan2(y - sensor_y, x - sensor_x) - sensor_heading, sigma_r)"
)toml";

const std::string kMany = R"toml([states]
h = "normal(0, 1)"
phi = "uniform(-pi, pi)"
[next]
phi = "wrap(phi + (0.1 + 0.05*abs(h))*normal(0, 1))"
h = "0.9*h - 0.5*normal(0, 1)/2"
[observations]
y = "normal(h, exp(h/2))"
bearing = "angle(phi, 0.2)"
z = "normal(min(h, 1)*t, 0.7)"
)toml";

TextModel made(const std::string& text) {
  const TextFile file = parse_text_file("m.toml", text);
  std::vector<double> parameters;
  for (const NamedNumber& p : file.parameters) parameters.push_back(p.value);
  return {file, parameters};
}

MOTE_MODEL_LAWS(GrowthText, made(kGrowth))
MOTE_MODEL_LAWS(ManyText, made(kMany))

TEST(TextFile, KeepsTheOrderOfTheFile) {
  const TextFile file = parse_text_file("models/m.toml", kMany);
  EXPECT_EQ(file.name, "m");
  EXPECT_EQ(file.states[0].key, "h");
  EXPECT_EQ(file.next[0].key, "h") << "by the order of the states";
  EXPECT_EQ(file.next[0].line, 6U);
  EXPECT_EQ(file.observations[2].key, "z");
  EXPECT_EQ(parse_text_file("m.toml", kGrowth).name, "growth");
}

TEST(TextModel, KnowsItsStatesAndColumns) {
  const TextModel many = made(kMany);
  EXPECT_FALSE(many.states()[0].angle);
  EXPECT_TRUE(many.states()[1].angle);
  EXPECT_TRUE(many.columns()[1].angle);
  EXPECT_EQ(many.columns()[1].state, "phi");
  const TextModel growth = made(kGrowth);
  ASSERT_EQ(growth.columns().size(), 2U);
  EXPECT_TRUE(growth.columns()[1].input);
  EXPECT_EQ(growth.columns()[1].fallback, 1.0);
}

/// |a - b| in units of the larger, at least 1.
double distance(double a, double b) { return std::abs(a - b) / std::max({1.0, std::abs(a), std::abs(b)}); }

// claim    the text of a catalogue model computes what its template computes
// referee  the template, in double
// design   50 steps of a simulated run, all functions, same draws; tolerance 1e-14, the rounding of about ten
// operations
template <class M>
void expect_same_model(const TextModel& text, const M& model) {
  const Row<double> inputs = blank_row(text);
  const Row<double> given = blank_row(model);
  auto block = Draws{31, 0}.block(Purpose::kTest);
  auto source = block.particle(0);
  const auto expect_near = [](const auto& a, const auto& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t d = 0; d < a.size(); ++d) EXPECT_LT(distance(a[d], b[d]), 1e-14);
  };
  for (Step t = 1; t <= 50; ++t) {
    const auto at = laws::scene(model, t, source);
    const auto listed = laws::listed(source);
    const TextModel::State<double> before(at.before.begin(), at.before.end());
    const TextModel::State<double> x(at.x.begin(), at.x.end());
    auto one = listed;
    auto other = listed;
    expect_near(text.initial<double>(one), model.template initial<double>(other));
    expect_near(text.next<double>(t, before, one), model.template next<double>(t, at.before, other));
    EXPECT_EQ(one.taken_normals, other.taken_normals);
    EXPECT_LT(distance(text.log_likelihood<double>(t, x, at.y), model.template log_likelihood<double>(t, at.x, at.y)),
              1e-13);
    expect_near(text.observe<double>(t, x, inputs, one).values,
                model.template observe<double>(t, at.x, given, other).values);
  }
}

TEST(TextModel, ComputesWhatTheTemplateDoes) {
  expect_same_model(made(kBearings), Bearings{});
  std::string plain = kGrowth;  // the template has no input
  plain.erase(plain.find("[inputs]"), plain.find("[states]") - plain.find("[inputs]"));
  plain.replace(plain.find("gain*"), 5, "");
  expect_same_model(made(plain), Ungm<1>{});
}

TEST(TextModel, HasTheTemplatesTransitionDensity) {
  const TextModel text = made(kGrowth);
  ASSERT_EQ(text.density(), Density::kState);
  for (const double x : {-3.0, 0.2, 7.0})
    for (const double before : {-1.0, 0.4, 12.0})
      EXPECT_NEAR(text.log_transition<double>(4, {x}, {before}), Ungm<1>{}.log_transition<double>(4, {x}, {before}),
                  1e-12);
}

TEST(TextModel, HasNoDensityWhereNoiseIsSharedOrBent) {
  EXPECT_EQ(made(kBearings).density(), Density::kNone);
  const auto density = [](const std::string& next) {
    return made("[states]\nx = 1\n[next]\nx = \"" + next + "\"\n[observations]\ny = \"normal(x, 1)\"").density();
  };
  EXPECT_EQ(density("x + normal(0, 1)"), Density::kState);
  EXPECT_EQ(density("x + x*normal(0, 1) - 3*(normal(0, 1) - x)"), Density::kNone) << "two draws";
  EXPECT_EQ(density("exp(normal(x, 1))"), Density::kNone);
  EXPECT_EQ(density("x + uniform(0, 1)"), Density::kNone);
  EXPECT_EQ(density("0.5*x"), Density::kNone);
  EXPECT_EQ(density("x + 0*normal(0, 1)"), Density::kNone);
}

TEST(TextModel, LeavesOutWhatWasNotSeen) {
  const TextModel model = made(kMany);
  const TextModel::State<double> x{0.3, 1.0};
  const auto likelihood = [&](const std::vector<bool>& present) {
    return model.log_likelihood<double>(2, x, {{0.5, 1.2, 0.8}, present});
  };
  const double all = likelihood({true, true, true});
  EXPECT_NEAR(all,
              likelihood({true, false, false}) + likelihood({false, true, false}) + likelihood({false, false, true}),
              1e-12);
  EXPECT_NEAR(likelihood({false, true, true}) + likelihood({true, false, false}), all, 1e-12);
}

TEST(TextModel, WeighsByALogLikelihoodOfItsOwn) {
  const std::string start = "[states]\nx = 1\n[next]\nx = \"x + normal(0, 1)\"\n[observations]\n";
  const TextModel model = made(start + "log_likelihood = \"-abs(y - x) - gust^2\"");
  ASSERT_EQ(model.columns().size(), 2U);
  EXPECT_EQ(model.columns()[1].name, "gust");
  EXPECT_EQ(model.log_likelihood<double>(1, {2.0}, Row<double>::of({5, 1})), -4);
  EXPECT_EQ(model.log_likelihood<double>(1, {2.0}, {{5, 1}, {true, false}}), 0) << "it needs both";
  auto block = Draws{1, 0}.block(Purpose::kTest);
  auto draw = block.particle(0);
  EXPECT_THROW(model.observe<double>(1, {2.0}, blank_row(model), draw), Refusal);
  const TextModel drawn = made(start + "y = \"normal(x, 1)\"\nlog_likelihood = \"-abs(y - x)\"");
  EXPECT_EQ(drawn.log_likelihood<double>(1, {2.0}, Row<double>::of({5})), -3);
  EXPECT_EQ(drawn.observe<double>(1, {2.0}, blank_row(drawn), draw).values.size(), 1U);
}

TEST(TextModel, IsRecordedLikeAnyModel) {
  const Recorded recorded = record(made(kGrowth));
  EXPECT_EQ(recorded.schedule(5)[0], 8 * std::cos(1.2 * 4));
  const std::map<std::string, std::size_t> moves{
      {"add", 4}, {"divide", 1}, {"multiply", 1}, {"multiply by constant", 3}};
  EXPECT_EQ(operations(recorded.graph, recorded.next), moves);
}

// claim    what follows t is a number of the schedule however late or short it does, be it for one step; one that two
//          right-hand sides have is one
// referee  the expressions by hand
TEST(TextModel, IsRecordedWithWhatFollowsTheTimeLater) {
  const Recorded recorded =
      record(made("[states]\nx = \"normal(0, 1)\"\nz = \"normal(0, 1)\"\n[next]\n"
                  "x = \"x + max(0, t - 50) + max(0, 1 - abs(t - 300)) + normal(0, 1)\"\n"
                  "z = \"z*max(0, t - 50) + x*min(t, 900) + 2*normal(0, 1)\"\n[observations]\ny = \"normal(x + z, 1 "
                  "+ max(0, 1 - abs(t - 300)))\"\n"));
  for (const Step t : {1, 49, 55, 299, 300, 301, 899, 5000}) {
    const std::vector<double> schedule = recorded.schedule(t);
    const double pulse = t == 300 ? 1 : 0;
    std::set<double> expected{std::max(0.0, static_cast<double>(t) - 50), pulse,
                              std::min(static_cast<double>(t), 900.0)};
    for (const double number : schedule) expected.erase(number);
    EXPECT_TRUE(expected.empty()) << t << ": " << schedule.size();
  }
}

std::string refusal_of(const std::string& text) {
  try {
    made(text);
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kBadData);
    return refusal.what();
  }
  return "accepted";
}

TEST(TextModel, RefusesByFileAndLine) {
  const std::string state = "[states]\nx = \"normal(0, 1)\"\n";
  const std::string next = state + "[next]\nx = \"x + normal(0, 1)\"\n";
  const std::string y = "[observations]\ny = \"normal(x, 1)\"\n";
  EXPECT_EQ(refusal_of(next + y), "accepted");
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal_of(text).find(part), std::string::npos) << refusal_of(text);
  };
  says("", "m.toml: [states]: expected at least one state with its prior, got nothing.");
  says(state + y, "m.toml: [next]: expected a right-hand side for the state \"x\", got nothing.");
  says(next, "m.toml: [observations]: expected at least one observation");
  says("x = ", "m.toml:1: expected TOML");
  says(next + y + "[weights]\n", "m.toml:7: expected a section or key of a model, got \"weights\".");
  says("[parameters]\na = \"b\"\n" + next + y, "m.toml:2: a: expected a finite number, got \"b\".");
  says("[parameters]\npi = 3\n" + next + y, "m.toml:2: \"pi\": expected a name");
  says("[parameters]\nx = 3\n" + next + y, "m.toml:4: \"x\": expected a name for one thing only, got a state");
  says(next + "z = 1\n" + y, "m.toml:5: [next]: expected a state of [states], got \"z\".");
  says(state + "[next]\nx = \"x + y\"\n" + y, "m.toml:4: x: expected a name that can be used here, got \"y\".");
  says("[states]\nx = \"x\"\n" + y, "m.toml: [next]");
  says("[states]\nx = \"x\"\n[next]\nx = \"x\"\n" + y,
       "m.toml:2: x: expected a name that can be used here, got \"x\".");
  says(next + "[observations]\ny = \"x\"", "m.toml:6: y: expected normal(mean, sd) or angle(mean, sd)");
  says(next + "[observations]\ny = \"\"", "m.toml:6: y: expected normal(mean, sd)");
  says(next + "[observations]\ny = true", "m.toml:6: y: expected an expression in quotes");
  says(next + "[observations]\nlog_likelihood = \"-x\"", "expected an expression of at least one observation");
  says("[parameters]\nq = -1\n" + state + "[next]\nx = \"x + sqrt(q)*normal(0, 1)\"\n" + y,
       "m.toml:6: x: expected parameters that give finite numbers");
}

}  // namespace
}  // namespace mote::graph
