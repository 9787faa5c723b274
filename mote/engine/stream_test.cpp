#include "mote/engine/stream.hpp"

#include <gtest/gtest.h>

#include "mote/engine/run.hpp"
#include "mote/filter/sisr.hpp"
#include "mote/model/ungm.hpp"

namespace mote {
namespace {

TEST(Latency, QuantilesAreRightWithinASixteenth) {
  Latency latency;
  EXPECT_EQ(latency.quantile(0.5).count(), 0);
  for (int k = 1; k <= 10000; ++k) latency.add(std::chrono::nanoseconds(k));
  EXPECT_EQ(latency.steps(), 10000U);
  EXPECT_NEAR(static_cast<double>(latency.quantile(0.5).count()), 5000, 5000.0 / 16);
  EXPECT_NEAR(static_cast<double>(latency.quantile(0.99).count()), 9900, 9900.0 / 16);
  EXPECT_EQ(latency.quantile(1).count(), 10000);
  EXPECT_EQ(latency.largest().count(), 10000);
}

TEST(Stream, GivesTheEstimatesOfARun) {
  const Ungm<1> model;
  Recording recording;
  for (Step t = 1; t <= 10; ++t)
    if (t != 4) recording.steps.push_back({t, {Row<double>::of({1.0 + t})}});
  RunRequest request;
  request.states = model.states();
  const auto filter = make_sisr(model, 500, 1);
  const auto rows = run(*filter, Plan{}, recording, request).rows;
  Stream stream(make_sisr(model, 500, 1), model.states(), model.columns());
  std::size_t k = 0;
  for (Step t = 1; t <= 10; ++t) {
    std::vector<Row<double>> now{Row<double>::of({1.0 + t})};
    if (t == 4) now[0].present[0] = false;
    const StreamEstimate& estimate = stream.step(now);
    EXPECT_EQ(estimate.t, t);
    if (t == 4) continue;
    EXPECT_EQ(estimate.states[0].mean, rows[k].states[0].mean);
    EXPECT_EQ(estimate.report.log_evidence, rows[k].report.log_evidence);
    ++k;
  }
  EXPECT_EQ(stream.latency().steps(), 10U);
}

}  // namespace
}  // namespace mote
