// The parallel particle filter in integers: rtl/filters/mote_groups.sv. Each lane is a group that resamples by itself; M of its
// children, evenly spread, have the parents that the group before it in the ring has drawn for its own.
#include "resample.h"

enum { Slots = Most / Lanes };

// A group's weights at its own scale, and what it draws its parents by.
typedef struct {
  mote_resampler resampler;
  mote_weight weights[Slots];
  uint64_t total, sums[Slots];
  uint32_t chosen[Slots];
} group;

struct filter {
  registers now;
  uint32_t t;
  group groups[Lanes];
  mote_words draw_words[Lanes][DrawWords];
  uint32_t set[Most][StateWords], parents[Most][StateWords];  // of a step before resampling; of its children
  int64_t log_weights[Most], of_group[Slots];
  mote_weight weights[Most];  // at the scale of all groups
};

static void filter_reset(struct filter *f) {
  uint32_t stream = 0;
  for (int l = 0; l < Lanes; ++l) f->groups[l].resampler.words = mote_stream(stream++);
  for (int l = 0; l < Lanes; ++l)
    for (int w = 0; w < DrawWords; ++w) f->draw_words[l][w] = mote_stream(stream++);
}

static int filter_takes(const registers *r) {
  return r->n >= 1 && r->n <= Most && r->n % Lanes == 0 && (uint64_t)Lanes * r->exchange <= r->n;
}

static void choose_parents(struct filter *f) {
  const uint32_t n = f->now.n / Lanes;
  for (int l = 0; l < Lanes; ++l) {
    group *own = &f->groups[l];
    mote_parents(&own->resampler, own->weights, n, own->total, SlotWidth, own->sums, own->chosen);
  }
  for (uint32_t child = 0, behind = n / 2; child < n; ++child) {
    behind += f->now.exchange;
    const int exchanged = behind >= n;
    if (exchanged) behind -= n;
    for (uint32_t l = 0; l < Lanes; ++l) {
      const uint32_t from = exchanged ? (l + Lanes - 1) % Lanes : l;
      const uint32_t *parent = f->set[f->groups[from].chosen[child] * Lanes + from];
      for (int w = 0; w < StateWords; ++w) f->parents[child * Lanes + l][w] = parent[w];
    }
  }
}

static void weigh_groups(struct filter *f) {
  const uint32_t n = f->now.n / Lanes;
  for (uint32_t l = 0; l < Lanes; ++l) {
    group *own = &f->groups[l];
    for (uint32_t k = 0; k < n; ++k) f->of_group[k] = f->log_weights[k * Lanes + l];
    mote_scale_weights(f->of_group, n, 1, own->weights);
    own->total = mote_sum(own->weights, n);
    mote_end_step(&own->resampler);
  }
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
  weigh_groups(f);
  mote_scale_weights(f->log_weights, n, Lanes, f->weights);
  estimate.sum = mote_sum(f->weights, n);
  estimate.scale = f->weights[n - 1].scale;
  for (int d = 0; d < Dims; ++d)
    estimate.mean[d] = mote_mean(f->set[0], StateWords, f->weights, n, d, estimate.sum);
  return estimate;
}
