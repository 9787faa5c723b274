// What all filters have: uniform words, weights at a scale that rises, sums and means. Needs operators.h and the sizes
// of a circuit (Dims, ValueWidth, ...).
#ifndef MOTE_FILTER_H
#define MOTE_FILTER_H

// ---- buses: 32-bit words, the lowest first

static inline int64_t mote_take(const uint32_t *bus, int at, int width, int is_signed) {
  uint64_t value = 0;
  for (int bit = 0; bit < width;) {
    const int in_word = (at + bit) % 32;
    const int taken = width - bit < 32 - in_word ? width - bit : 32 - in_word;
    const uint64_t part = (bus[(at + bit) / 32] >> in_word) & ((UINT64_C(1) << taken) - 1);
    value |= part << bit;
    bit += taken;
  }
  return mote_cut(value, is_signed, width);
}

static inline void mote_put(uint32_t *bus, int at, int width, int64_t value) {
  for (int bit = 0; bit < width; ++bit) {
    uint32_t *word = &bus[(at + bit) / 32];
    const uint32_t mask = UINT32_C(1) << ((at + bit) % 32);
    *word = ((uint64_t)value >> bit & 1) != 0 ? *word | mask : *word & ~mask;
  }
}

// ---- uniform words: rtl/mote_words.sv

typedef struct {
  uint32_t a, b, c;
} mote_words;

static inline uint32_t mote_mixed(uint64_t seed, uint32_t stream, uint32_t number) {
  uint64_t z = seed + ((uint64_t)stream * 3 + number) * UINT64_C(0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return (uint32_t)((z ^ (z >> 31)) >> 32);
}

static inline mote_words mote_stream(uint32_t stream) {
  const mote_words words = {mote_mixed(Seed, stream, 1) | 2, mote_mixed(Seed, stream, 2) | 8,
                            mote_mixed(Seed, stream, 3) | 16};
  return words;
}

static inline uint32_t mote_word(const mote_words *w) { return w->a ^ w->b ^ w->c; }

static inline uint32_t mote_next(mote_words *w) {
  const uint32_t present = mote_word(w);
  w->a = ((w->a & UINT32_C(0xFFFFFFFE)) << 12) ^ (((w->a << 13) ^ w->a) >> 19);
  w->b = ((w->b & UINT32_C(0xFFFFFFF8)) << 4) ^ (((w->b << 2) ^ w->b) >> 25);
  w->c = ((w->c & UINT32_C(0xFFFFFFF0)) << 17) ^ (((w->c << 3) ^ w->c) >> 11);
  return present;
}

// ---- weights: rtl/filters/mote_weight.sv, mote_log_uniform.sv

// Fraction bits of log weights; octaves of a step of scale; steps below the scale from which on a weight is nothing; bits
// of a weight's mantissa behind its leading one.
enum { kLogFraction = 10, kQuantum = 8, kNothing = 3, kMantissaBits = 12 };

typedef struct {
  uint64_t weight;
  int64_t scale;
  int rise;  // steps of scale that sums so far go down by before this weight is added
} mote_weight;

static inline int64_t mote_lowered(int64_t number, int steps) {
  return steps >= kNothing ? 0 : number >> (kQuantum * steps);
}
static inline int mote_steps_between(int64_t before, int64_t after) {
  return after - before > kNothing ? kNothing : (int)(after - before);
}
static inline int64_t mote_scale_needed(int64_t log_weight) { return (log_weight >> (kLogFraction + 3)) + 1; }

static inline uint64_t mote_weight_at(int64_t log_weight, int64_t scale) {
  const uint64_t power = u_filter_exp2table[log_weight & 1023].low | UINT64_C(1) << kMantissaBits;
  const int fine = (int)(7 - ((log_weight >> kLogFraction) & 7));
  const int64_t whole = (int64_t)(power << (WeightWidth - 1 - kMantissaBits));
  return (uint64_t)mote_lowered(whole, mote_steps_between(mote_scale_needed(log_weight), scale)) >> fine;
}

// Rows of `lanes` log weights to weights.
static inline void mote_scale_weights(const int64_t *log_weights, uint32_t count, uint32_t lanes, mote_weight *weights) {
  int64_t scale = 0;
  for (uint32_t row = 0; row < count; row += lanes) {
    int64_t most = log_weights[row];
    for (uint32_t lane = 1; lane < lanes; ++lane)
      if (log_weights[row + lane] > most) most = log_weights[row + lane];
    const int64_t needed = mote_scale_needed(most);
    const int64_t risen = row == 0 || needed > scale ? needed : scale;
    for (uint32_t lane = 0; lane < lanes; ++lane) {
      const mote_weight weight = {mote_weight_at(log_weights[row + lane], risen), risen, 0};
      weights[row + lane] = weight;
    }
    if (row > 0) weights[row].rise = mote_steps_between(scale, risen);
    scale = risen;
  }
}

// ---- what a step gives: rtl/filters/mote_estimate.sv

typedef struct {
  int64_t mean[Dims];
  uint64_t sum;
  int64_t scale;
  uint64_t accepted;  // moves of the chain, where there is one
} mote_estimate;

static inline uint64_t mote_sum(const mote_weight *weights, uint32_t count) {
  uint64_t sum = 0;
  for (uint32_t i = 0; i < count; ++i) sum = (uint64_t)mote_lowered((int64_t)sum, weights[i].rise) + weights[i].weight;
  return sum;
}

// The weighted mean of state d, rounded down, of particles of `words` words each; those without weights count alike. Products
// are rounded to what a unit of weight times the largest state is.
static inline int64_t mote_mean(const uint32_t *states, int words, const mote_weight *weights, uint32_t count, int d,
                                uint64_t divisor) {
  const int dropped = ValueWidth - 1;
  const int64_t half = INT64_C(1) << (dropped - 1);
  int64_t total = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const int64_t value = mote_take(states + (uint64_t)i * (uint64_t)words, d * ValueWidth, ValueWidth, 1);
    const int64_t weight = weights == 0 ? 1 << 16 : (int64_t)weights[i].weight;
    total = mote_lowered(total, weights == 0 ? 0 : weights[i].rise) + ((value * weight + half) >> dropped);
  }
  const mote_wide numerator = mote_lifted(total, dropped + Extra);
  const mote_wide cut = numerator / (mote_wide)divisor;
  return (int64_t)(cut - (cut * (mote_wide)divisor > numerator ? 1 : 0));
}

#endif
