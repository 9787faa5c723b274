// Resampling of a set of weights: the parents of its children. Scheme is a number of rtl/filters/mote_resample.sv.
//
//   0 systematic, 1 residual-systematic: children up to particle i: floor(C_i N / T + u), C_i / T as 17 bits, by a reciprocal of T;
//                                        the last one's are N (rtl/filters/mote_offspring.sv)
//   2 roulette:                          of each child the least i with C_i > floor(u T) (rtl/filters/mote_roulette.sv)
#ifndef MOTE_RESAMPLE_H
#define MOTE_RESAMPLE_H

static inline int mote_by_roulette(void) { return (int)Scheme == 2; }

typedef struct {
  mote_words words;
  uint32_t uniform;  // of the step that ended, 24 bits
} mote_resampler;

static inline void mote_end_step(mote_resampler *r) {
  if (!mote_by_roulette()) r->uniform = mote_next(&r->words) >> 8;
}

// 2^35 / x to 13 bits, x of 18 bits with the top one set: by the tangent in the middle of one of 64 segments.
static inline uint32_t mote_reciprocal(uint32_t x) {
  const uint32_t middle = 129 + 2 * ((x >> 11) & 63);
  const uint32_t square = middle * middle;
  const uint32_t base = (uint32_t)(((uint64_t)(middle + 1) << 25) / square);
  const uint32_t slope = ((UINT32_C(1) << 26) + square - 1) / square;
  return ((base << 11) - slope * (x & 2047)) >> 11;
}

// A number of weight i's scale at the last one's.
static inline uint64_t mote_at_last(const mote_weight *weights, uint32_t n, uint32_t i, uint64_t number) {
  return (uint64_t)mote_lowered((int64_t)number, mote_steps_between(weights[i].scale, weights[n - 1].scale));
}

static inline void mote_parents_by_shares(const mote_resampler *r, const mote_weight *weights, uint32_t n, uint64_t total,
                                          int count_bits, uint32_t *parents) {
  const int sum_bits = WeightWidth + count_bits, drop = count_bits - 6, fraction = 34 - drop;
  const int zeros = sum_bits - mote_bit_width(total);
  const uint64_t factor = ((uint64_t)mote_reciprocal((uint32_t)((total << zeros) >> (sum_bits - 18))) * n) >> drop;
  uint64_t sum = 0;
  for (uint32_t i = 0, child = 0; i < n; ++i) {
    sum += (mote_at_last(weights, n, i, weights[i].weight) << zeros) >> count_bits;
    const uint64_t share = sum >> (WeightWidth - 17);
    const uint64_t place = share * factor + ((uint64_t)r->uniform << (fraction - 24));
    const uint32_t end = i + 1 == n ? n : (uint32_t)(place >> fraction);
    for (; child < end && child < n; ++child) parents[child] = i;
  }
}

static inline void mote_parents_by_roulette(mote_resampler *r, const mote_weight *weights, uint32_t n, uint64_t total,
                                            uint64_t *sums, uint32_t *parents) {
  uint64_t sum = 0;
  for (uint32_t i = 0; i + 1 < n; ++i) {
    sum = (uint64_t)mote_lowered((int64_t)sum, weights[i].rise) + weights[i].weight;
    sums[i] = mote_at_last(weights, n, i, sum);
  }
  for (uint32_t child = 0; child < n; ++child) {
    const uint64_t threshold = (uint64_t)(((mote_wide)total * (mote_next(&r->words) >> 8)) >> 24);
    uint32_t low = 0, high = n - 1;  // the first sum above is in [low, high]
    while (low < high) {
      const uint32_t middle = (low + high) / 2;
      if (sums[middle] > threshold)
        high = middle;
      else
        low = middle + 1;
    }
    parents[child] = low;
  }
}

// The parents of n children; counts go up to 2^count_bits. sums: room for n.
static inline void mote_parents(mote_resampler *r, const mote_weight *weights, uint32_t n, uint64_t total, int count_bits,
                                uint64_t *sums, uint32_t *parents) {
  if (mote_by_roulette())
    mote_parents_by_roulette(r, weights, n, total, sums, parents);
  else
    mote_parents_by_shares(r, weights, n, total, count_bits, parents);
}

#endif
