// The bootstrap filter with systematic resampling every step, in integers: rtl/filters/mote_sisr.sv, mote_sisr_plain.sv.
//
//   children up to particle i: floor(C_i N / T + u), C_i / T as 17 bits, by a reciprocal of T; the last one's are N
//   (rtl/filters/mote_offspring.sv)

struct filter {
  registers now;
  uint32_t t;
  mote_words resample_words, draw_words[Lanes][DrawWords];
  uint32_t set[Most][StateWords], parents[Most][StateWords];  // of a step before resampling; of its children
  int64_t log_weights[Most];
  mote_weight weights[Most];
  uint64_t total;
  uint32_t uniform;
};

static void filter_reset(struct filter *f) {
  uint32_t stream = 0;
  f->resample_words = mote_stream(stream++);
  for (int lane = 0; lane < Lanes; ++lane)
    for (int w = 0; w < DrawWords; ++w) f->draw_words[lane][w] = mote_stream(stream++);
}

static int filter_takes(const registers *r) { return r->n >= 1 && r->n <= Most && r->n % Lanes == 0; }

static void take_parent(struct filter *f, uint32_t child, uint32_t parent) {
  for (int w = 0; w < StateWords; ++w) f->parents[child][w] = f->set[parent][w];
}

// 2^35 / x to 13 bits, x of 18 bits with the top one set: by the tangent in the middle of one of 64 segments.
static uint32_t reciprocal_of(uint32_t x) {
  const uint32_t middle = 129 + 2 * ((x >> 11) & 63);
  const uint32_t square = middle * middle;
  const uint32_t base = (uint32_t)(((uint64_t)(middle + 1) << 25) / square);
  const uint32_t slope = ((UINT32_C(1) << 26) + square - 1) / square;
  return ((base << 11) - slope * (x & 2047)) >> 11;
}

// A weight at the last scale.
static uint64_t at_last_scale(const struct filter *f, uint32_t i) {
  const mote_weight *w = &f->weights[i];
  return (uint64_t)mote_lowered((int64_t)w->weight, mote_steps_between(w->scale, f->weights[f->now.n - 1].scale));
}

static void choose_parents(struct filter *f) {
  const uint32_t n = f->now.n;
  const int sum_bits = WeightWidth + At, drop = At - 6, fraction = 34 - drop;
  const int zeros = sum_bits - mote_bit_width(f->total);
  const uint64_t factor =
      ((uint64_t)reciprocal_of((uint32_t)((f->total << zeros) >> (sum_bits - 18))) * n) >> drop;
  uint64_t sum = 0;
  for (uint32_t i = 0, child = 0; i < n; ++i) {
    sum += (at_last_scale(f, i) << zeros) >> At;
    const uint64_t share = sum >> (WeightWidth - 17);
    const uint64_t place = share * factor + ((uint64_t)f->uniform << (fraction - 24));
    const uint32_t end = i + 1 == n ? n : (uint32_t)(place >> fraction);
    for (; child < end && child < n; ++child) take_parent(f, child, i);
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
  mote_scale_weights(f->log_weights, n, f->weights);
  f->total = estimate.sum = mote_sum(f->weights, n);
  f->uniform = mote_next(&f->resample_words) >> 8;
  estimate.scale = f->weights[n - 1].scale;
  for (int d = 0; d < Dims; ++d) estimate.mean[d] = mote_mean(f->set, f->weights, n, d, estimate.sum);
  return estimate;
}
