// The bootstrap filter with resampling every step, in integers: rtl/filters/mote_sisr.sv, mote_sisr_plain.sv.
#include "resample.h"

struct filter {
  registers now;
  uint32_t t;
  mote_resampler resampler;
  mote_words draw_words[Lanes][DrawWords];
  uint32_t set[Most][StateWords], parents[Most][StateWords];  // of a step before resampling; of its children
  uint32_t chosen[Most];
  int64_t log_weights[Most];
  mote_weight weights[Most];
  uint64_t total, sums[Most];
};

static void filter_reset(struct filter *f) {
  uint32_t stream = 0;
  f->resampler.words = mote_stream(stream++);
  for (int lane = 0; lane < Lanes; ++lane)
    for (int w = 0; w < DrawWords; ++w) f->draw_words[lane][w] = mote_stream(stream++);
}

static int filter_takes(const registers *r) { return r->n >= 1 && r->n <= Most && r->n % Lanes == 0; }

static void choose_parents(struct filter *f) {
  mote_parents(&f->resampler, f->weights, f->now.n, f->total, At, f->sums, f->chosen);
  for (uint32_t child = 0; child < f->now.n; ++child)
    for (int w = 0; w < StateWords; ++w) f->parents[child][w] = f->set[f->chosen[child]][w];
}

static mote_estimate filter_step(struct filter *f, const uint32_t *obs) {
  const uint32_t n = f->now.n;
  mote_estimate estimate = {{0}, 0, 0, 0};
  if (f->t > 1) choose_parents(f);
  for (uint32_t j = 0; j < n; ++j) {
    uint32_t words[DrawWords];
    for (int w = 0; w < DrawWords; ++w) words[w] = mote_next(&f->draw_words[j % Lanes][w]);
    model_propose(f->t, obs, f->parents[j], words, f->set[j]);
    f->log_weights[j] = model_weigh(f->t, obs, f->set[j]);
  }
  mote_scale_weights(f->log_weights, n, Lanes, f->weights);
  f->total = estimate.sum = mote_sum(f->weights, n);
  mote_end_step(&f->resampler);
  estimate.scale = f->weights[n - 1].scale;
  for (int d = 0; d < Dims; ++d)
    estimate.mean[d] = mote_mean(f->set[0], StateWords, f->weights, n, d, estimate.sum);
  return estimate;
}
