// Independent Metropolis-Hastings in integers: rtl/filters/mote_imh.sv.
//
//   j = 0 .. Q / Lanes + N_b - 1 in every lane:  x' from a parent drawn of the last set, accepted iff j = 0 or
//   lw <= lw' - log2 u;  the last N / Lanes states of each chain are the next set
//
// Folded: one chain visits rows of Lanes proposals, lane by lane. Overlapped: the first rows of a step choose their parents among
// the states that had emerged when they began. Several lanes always take turns at the memories of states, as all circuits that
// mote writes do, which has a cycle of the window. Proposals of pairs carry their parent to be weighed.

enum {
  PairWords = (Dims * ValueWidth + CarryWidth + 31) / 32,
  Chains = Folded ? 1 : Lanes,
  Window = 3 + Product + (Lanes > 1) + ProposeLatency + WeighLatency + (Folded && Lanes > 1 ? Lanes + 2 : 1) - 1
};

struct filter {
  registers now;
  uint32_t t;
  mote_words parent_words[Lanes], accept_words[Lanes], draw_words[Lanes][DrawWords];
  uint32_t set[Most][StateWords];
  uint32_t proposals[1 << At][PairWords];
  uint32_t kept[Most];
  int64_t log_weights[1 << At];
  mote_weight weights[1 << At];
};

static void filter_reset(struct filter *f) {
  uint32_t stream = 0;
  for (int lane = 0; lane < Lanes; ++lane) {
    f->parent_words[lane] = mote_stream(stream++);
    f->accept_words[lane] = mote_stream(stream++);
    for (int w = 0; w < DrawWords; ++w) f->draw_words[lane][w] = mote_stream(stream++);
  }
}

// Proposals of a step that the chains forget: each its own, or the one by whole rows.
static uint64_t burnt(const registers *r) {
  return Lanes * (Folded ? ((uint64_t)r->burn_in + Lanes - 1) / Lanes : (uint64_t)r->burn_in);
}

static int filter_takes(const registers *r) {
  return r->n >= 1 && r->n <= Most && r->n % Lanes == 0 && r->draws % Lanes == 0 && r->n <= r->draws &&
         r->draws + burnt(r) <= UINT64_C(1) << At;
}

static int64_t log_drop(uint32_t word) {
  const int zeros = 32 - mote_bit_width(word);
  const uint32_t leading = word == 0 ? 0 : word << zeros;
  const uint32_t mantissa = (leading >> 21) & 1023;
  return ((int64_t)(zeros + 1) << kLogFraction) - (int64_t)(mantissa + u_filter_log2table[mantissa >> 3].low);
}

// Slots that the parents of a row are chosen among.
static uint32_t slots_of(const struct filter *f, uint32_t row) {
  const uint32_t all = f->now.n / Lanes;
  const uint32_t later = all / 2 < (uint32_t)Window ? all / 2 : (uint32_t)Window;
  return Overlapped && row < later ? all - later + row : all;
}

// Where the parent of a proposal stands: the lanes take turns at the chains.
static uint32_t parent_of(struct filter *f, uint32_t lane, uint32_t turn, uint32_t slots) {
  const uint32_t word = mote_next(&f->parent_words[lane]);
  const uint32_t slot = (uint32_t)(((uint64_t)(word >> 8) * slots) >> 24);
  return slot * Lanes + (lane + turn) % Lanes;
}

static void propose(struct filter *f, const uint32_t *obs, uint32_t row) {
  const uint32_t turn = mote_word(&f->parent_words[0]) >> (8 - mote_ceil_log2(Lanes));
  for (uint32_t lane = 0; lane < Lanes; ++lane) {
    uint32_t words[DrawWords];
    const uint32_t *parent = f->set[parent_of(f, lane, turn, slots_of(f, row / Lanes))];
    for (int w = 0; w < DrawWords; ++w) words[w] = mote_next(&f->draw_words[lane][w]);
    model_propose(f->t, obs, parent, words, f->proposals[row + lane]);
    f->log_weights[row + lane] = model_weigh(f->t, obs, f->proposals[row + lane]);
  }
}

// Runs a chain; says how often it moved.
static uint64_t decide(struct filter *f, uint32_t count, uint32_t chain) {
  const uint32_t dropped = count - f->now.n;
  uint32_t current = chain;
  uint64_t accepted = 0;
  for (uint32_t j = chain; j < count; j += Chains) {
    const int64_t drop = log_drop(mote_next(&f->accept_words[j % Lanes]));
    if (j > chain && f->log_weights[current] <= f->log_weights[j] + drop) {
      current = j;
      ++accepted;
    }
    if (j >= dropped) f->kept[j - dropped] = current;
  }
  return accepted;
}

static mote_estimate filter_step(struct filter *f, const uint32_t *obs) {
  const uint32_t count = f->now.draws + (uint32_t)burnt(&f->now);
  mote_estimate estimate = {{0}, 0, 0, 0};
  for (uint32_t row = 0; row < count; row += Lanes) propose(f, obs, row);
  for (uint32_t chain = 0; chain < Chains; ++chain) estimate.accepted += decide(f, count, chain);
  for (uint32_t k = 0; k < f->now.n; ++k)
    for (int w = 0; w < StateWords; ++w) f->set[k][w] = f->proposals[f->kept[k]][w];
  mote_scale_weights(f->log_weights, count, Lanes, f->weights);
  estimate.sum = mote_sum(f->weights, count);
  estimate.scale = f->weights[count - 1].scale;
  for (int d = 0; d < Dims; ++d)
    estimate.mean[d] = f->now.chain_mean
                           ? mote_mean(f->set[0], StateWords, 0, f->now.n, d, (uint64_t)f->now.n << 16)
                           : mote_mean(f->proposals[0], PairWords, f->weights, count, d, estimate.sum);
  return estimate;
}
