#pragma once
/// The figures of a regenerated item: charts, and the numbers behind them.

#include "mote/app/reproduce/laboratory.hpp"
#include "mote/report/page.hpp"

namespace mote::reproduce {

/// The chart of a figure: every run and the truth, over time or in the plane. An angle that jumps by more than half a
/// turn breaks its line.
report::Chart chart_of(const Item& item, const Figure& figure, const Outcome& outcome);

/// The numbers behind an item's figures as CSV: t, the truth and each run's mean and sd of every state
/// ("imh_theta_mean"); of an item on weights: run, ess, error, ns_per_draw;
/// of an item on a clip: run, particles, repeat and the figures of the track; of one with errors against something:
/// figure, run, number, median_mse with its 95 % interval, messages_per_step, bytes_per_step; of an item on clusters:
/// run, ranks by stages, seconds and speed-up; of an item of designs: figure, run, blocks, time by law and exact; of
/// one on analog circuits: figure, series, x, y.
std::string figure_csv(const Outcome& outcome);

}  // namespace mote::reproduce
