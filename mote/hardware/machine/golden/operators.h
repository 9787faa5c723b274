// What the modules of rtl/ compute, in C99 with the 128-bit integers of GCC and Clang: a function for each module that
// is an operator, under its name, with a structure of its parameters. Words are in units of their formats' steps.
//
//   mote_MODULE(parameters, inputs ..., outputs ...)
//
// Right shifts of negative numbers have to be arithmetic, as GCC and Clang do them.
#ifndef MOTE_OPERATORS_H
#define MOTE_OPERATORS_H

#include <stdint.h>

__extension__ typedef __int128 mote_wide;

// A word of a table, of up to 128 bits.
typedef struct {
  uint64_t low, high;
} mote_entry;

static inline int mote_bit_width(uint64_t x) {
  int bits = 0;
  while (bits < 64 && x >> bits != 0) ++bits;
  return bits;
}
static inline int mote_ceil_log2(uint64_t n) {
  int bits = 0;
  while (UINT64_C(1) << bits < n) ++bits;
  return bits;
}
static inline mote_wide mote_lifted(mote_wide number, int places) { return number * ((mote_wide)1 << places); }
static inline mote_wide mote_larger(mote_wide a, mote_wide b) { return a > b ? a : b; }
static inline int mote_most(int a, int b) { return a > b ? a : b; }
static inline int64_t mote_greatest(int is_signed, int width) { return (INT64_C(1) << (width - is_signed)) - 1; }
static inline int64_t mote_least(int is_signed, int width) { return is_signed ? -(INT64_C(1) << (width - 1)) : 0; }

// The lowest bits, as a signed or an unsigned number.
static inline int64_t mote_cut(uint64_t bits, int is_signed, int width) {
  const uint64_t kept = bits << (64 - width);
  return is_signed ? (int64_t)kept >> (64 - width) : (int64_t)(kept >> (64 - width));
}

// The signed field of an entry from bit `at` on.
static inline int64_t mote_field(mote_entry entry, int at, int width) {
  const uint64_t bits = at >= 64 ? entry.high >> (at - 64)
                                 : entry.low >> at | (at == 0 ? 0 : entry.high << (64 - at));
  return mote_cut(bits, 1, width);
}

// A number of `fraction` bits after the point in another format.
static inline int64_t mote_resized(mote_wide number, int fraction, int y_signed, int y_width, int y_fraction,
                                   int nearest, int saturate) {
  const int drop = fraction - y_fraction;
  if (drop <= 0) {
    number = mote_lifted(number, -drop);
  } else {
    if (nearest) number += (mote_wide)1 << (drop - 1);
    number >>= drop;
  }
  if (!saturate) return mote_cut((uint64_t)number, y_signed, y_width);
  if (number > mote_greatest(y_signed, y_width)) return mote_greatest(y_signed, y_width);
  if (number < mote_least(y_signed, y_width)) return mote_least(y_signed, y_width);
  return (int64_t)number;
}

// ---- y = a + b, or a - b

typedef struct {
  int ASigned, AWidth, AFraction, BSigned, BWidth, BFraction, YSigned, YWidth, YFraction;
  int Subtract, Nearest, Saturate;
} mote_add_parameters;

static inline void mote_add(const mote_add_parameters *p, int64_t a, int64_t b, int64_t *y) {
  const int fraction = mote_most(p->AFraction, p->BFraction);
  const mote_wide first = mote_lifted(a, fraction - p->AFraction), second = mote_lifted(b, fraction - p->BFraction);
  *y = mote_resized(p->Subtract ? first - second : first + second, fraction, p->YSigned, p->YWidth, p->YFraction,
                    p->Nearest, p->Saturate);
}

// ---- y = a b

typedef struct {
  int ASigned, AWidth, AFraction, BSigned, BWidth, BFraction, YSigned, YWidth, YFraction;
  int Nearest, Saturate, Logic;
} mote_multiply_parameters;

static inline void mote_multiply(const mote_multiply_parameters *p, int64_t a, int64_t b, int64_t *y) {
  *y = mote_resized((mote_wide)a * b, p->AFraction + p->BFraction, p->YSigned, p->YWidth, p->YFraction, p->Nearest,
                    p->Saturate);
}

// ---- y = a b + c

typedef struct {
  int AWidth, BWidth, CWidth, YWidth, Logic;
} mote_multiply_add_parameters;

static inline void mote_multiply_add(const mote_multiply_add_parameters *p, int64_t a, int64_t b, int64_t c,
                                     int64_t *y) {
  (void)p;
  *y = a * b + c;
}

// ---- y = a in another format, behind a register

typedef struct {
  int InWidth, InFraction, OutSigned, OutWidth, OutFraction, Nearest, Saturate, InRegister;
} mote_finish_parameters;

static inline void mote_finish(const mote_finish_parameters *p, int64_t a, int64_t *y) {
  *y = mote_resized(a, p->InFraction, p->OutSigned, p->OutWidth, p->OutFraction, p->Nearest, p->Saturate);
}

// ---- y = a c,  c = (Plus - Minus) 2^-CFraction

typedef struct {
  int ASigned, AWidth, AFraction, CWidth, CFraction;
  uint64_t Plus, Minus;
  int Depth, YSigned, YWidth, YFraction, Nearest, Saturate;
} mote_multiply_constant_parameters;

static inline void mote_multiply_constant(const mote_multiply_constant_parameters *p, int64_t a, int64_t *y) {
  const int64_t constant = (int64_t)p->Plus - (int64_t)p->Minus;
  *y = mote_resized((mote_wide)a * constant, p->AFraction + p->CFraction, p->YSigned, p->YWidth, p->YFraction,
                    p->Nearest, p->Saturate);
}

// ---- y = a in another format

typedef struct {
  int ASigned, AWidth, AFraction, YSigned, YWidth, YFraction, Nearest, Saturate;
} mote_convert_parameters;

static inline void mote_convert(const mote_convert_parameters *p, int64_t a, int64_t *y) {
  *y = mote_resized(a, p->AFraction, p->YSigned, p->YWidth, p->YFraction, p->Nearest, p->Saturate);
}

// ---- y = s ? -a : a, saturated

typedef struct {
  int ASigned, AWidth, YSigned, YWidth;
} mote_negate_if_parameters;

static inline void mote_negate_if(const mote_negate_if_parameters *p, int64_t s, int64_t a, int64_t *y) {
  *y = mote_resized(s != 0 ? -(mote_wide)a : a, 0, p->YSigned, p->YWidth, 0, 0, 1);
}

// ---- y = a < b

typedef struct {
  int ASigned, AWidth, AFraction, BSigned, BWidth, BFraction;
} mote_less_parameters;

static inline void mote_less(const mote_less_parameters *p, int64_t a, int64_t b, int64_t *y) {
  const int fraction = mote_most(p->AFraction, p->BFraction);
  *y = mote_lifted(a, fraction - p->AFraction) < mote_lifted(b, fraction - p->BFraction);
}

// ---- y = s ? a : b

typedef struct {
  int Width, Register;
} mote_select_parameters;

static inline void mote_select(const mote_select_parameters *p, int64_t s, int64_t a, int64_t b, int64_t *y) {
  (void)p;
  *y = s != 0 ? a : b;
}

// ---- y = min(a, b), or max(a, b)

typedef struct {
  int Signed, Width, Greater;
} mote_extremum_parameters;

static inline void mote_extremum(const mote_extremum_parameters *p, int64_t a, int64_t b, int64_t *y) {
  *y = (a < b) == (p->Greater != 0) ? b : a;
}

// ---- m = x << s, n = n << s: x's leading one at the top

typedef struct {
  int Width, EWidth, Even;
} mote_normalise_parameters;

static inline void mote_normalise(const mote_normalise_parameters *p, int64_t x, int64_t n, int64_t *e, int64_t *m,
                                  int64_t *n_out) {
  const int place = mote_most(0, mote_bit_width((uint64_t)x) - 1);
  const int shift = p->Even ? (p->Width - 1 - place) / 2 * 2 : p->Width - 1 - place;
  *e = p->Even ? shift / 2 : p->Width - 1 - shift;
  *m = mote_cut((uint64_t)x << shift, 0, p->Width);
  *n_out = mote_cut((uint64_t)n << shift, 0, p->Width);
}

// ---- y = m 2^-s, to the nearest, saturated; all unsigned

typedef struct {
  int MWidth, MFraction, SWidth, YWidth, YFraction;
} mote_scale_parameters;

static inline void mote_scale(const mote_scale_parameters *p, int64_t m, int64_t s, int64_t *y) {
  const int lift = p->YFraction + 1 - p->MFraction;
  const mote_wide wide = lift >= 0 ? mote_lifted(m, lift) : (mote_wide)m >> -lift;
  const mote_wide rounded = s > 126 ? 0 : ((wide >> s) + 1) >> 1;
  *y = rounded > mote_greatest(0, p->YWidth) ? mote_greatest(0, p->YWidth) : (int64_t)rounded;
}

// ---- rotations by shifts and additions

typedef struct {
  int Mode, Vectoring, Width, ZWidth, Stages;
  const int64_t *Shifts, *Angles;  // from the first stage on
} mote_cordic_parameters;

static inline void mote_cordic(const mote_cordic_parameters *p, int64_t x, int64_t y, int64_t z, int64_t *x_out,
                               int64_t *y_out, int64_t *z_out) {
  for (int stage = 0; stage < p->Stages; ++stage) {
    const int negative = p->Vectoring ? y >= 0 : z < 0;
    const int64_t dx = y >> p->Shifts[stage], dy = x >> p->Shifts[stage];
    if (p->Mode != 1) x += negative == (p->Mode == 0) ? dx : -dx;
    y += negative ? -dy : dy;
    z += negative ? p->Angles[stage] : -p->Angles[stage];
    x = mote_cut((uint64_t)x, 1, p->Width);
    y = mote_cut((uint64_t)y, 1, p->Width);
    z = mote_cut((uint64_t)z, 1, p->ZWidth);
  }
  *x_out = x;
  *y_out = y;
  *z_out = z;
}

// ---- a function as polynomials on segments: the place u of x, its segment, the polynomial there

typedef struct {
  int XSigned, XWidth, Fold, Centre, UWidth, Bottom, SegmentBits, DeltaBits, Degree, C0Width, C1Width, C2Width;
  const mote_entry *Table;
} mote_piecewise_cell_parameters;

static inline void mote_piecewise_cell(const mote_piecewise_cell_parameters *p, int64_t x, int64_t *c0, int64_t *c1,
                                       int64_t *c2, int64_t *delta, int64_t *side) {
  enum { kPlain = 0, kSides = 1, kMirrored = 4 };
  uint64_t u;
  int negative = 0;
  if (p->Fold == kPlain) {
    u = (uint64_t)(x - mote_least(p->XSigned, p->XWidth));
  } else if (p->Fold == kMirrored) {
    negative = x < 0;
    u = (uint64_t)(negative ? ~x : x);
  } else {
    const int64_t from = x - p->Centre;
    const uint64_t most = (UINT64_C(1) << p->UWidth) - 1;
    negative = from < 0;
    u = (uint64_t)(negative ? -from : from);
    if (u > most) u = most;
  }
  const int regions = p->UWidth - p->Bottom + 1;
  const int region = mote_most(0, mote_bit_width(u) - p->Bottom);
  const int lost = 64 - (regions > 1 ? p->Bottom + mote_most(region, 1) - 1 : p->Bottom);
  const uint64_t field = lost == 64 ? 0 : u << lost;
  const uint64_t segment = field >> (64 - p->SegmentBits);
  const uint64_t place = (field << p->SegmentBits) >> (64 - p->DeltaBits);
  const uint64_t other = p->Fold == kSides && negative ? UINT64_C(1) << mote_ceil_log2((uint64_t)regions) : 0;
  const mote_entry entry = p->Table[((other + (uint64_t)region) << p->SegmentBits) + segment];
  *c0 = mote_field(entry, 0, p->C0Width);
  *c1 = mote_field(entry, p->C0Width, p->C1Width);
  *c2 = p->Degree == 1 ? 0 : mote_field(entry, p->C0Width + p->C1Width, p->C2Width);
  *delta = (int64_t)place - (INT64_C(1) << (p->DeltaBits - 1));
  *side = negative;
}

typedef struct {
  int XSigned, XWidth, Fold, Centre, UWidth, Bottom, SegmentBits, DeltaBits, Degree, C0Width, C1Width, C2Width, Guard,
      YSigned, YWidth, Logic;
  const mote_entry *Table;
} mote_piecewise_parameters;

static inline void mote_piecewise(const mote_piecewise_parameters *p, int64_t x, int64_t *y) {
  enum { kOdd = 2, kMirrored = 4 };
  const mote_piecewise_cell_parameters cell = {p->XSigned, p->XWidth, p->Fold, p->Centre, p->UWidth, p->Bottom,
                                               p->SegmentBits, p->DeltaBits, p->Degree, p->C0Width, p->C1Width,
                                               p->C2Width, p->Table};
  int64_t c0, c1, c2, delta, side;
  mote_piecewise_cell(&cell, x, &c0, &c1, &c2, &delta, &side);
  const int64_t slope = c1 + ((c2 * delta) >> p->DeltaBits);
  const int64_t kept = (c0 + ((slope * delta) >> p->DeltaBits)) >> p->Guard;
  const int64_t exact = side && (p->Fold == kOdd || p->Fold == kMirrored) ? -kept : kept;
  *y = mote_resized(exact, 0, p->YSigned, p->YWidth, 0, 0, 1);
}

// ---- a table of all values; who reads it knows whether they are signed

typedef struct {
  int AddressWidth, Width, OutRegister, Logic;
  const mote_entry *File;
} mote_rom_parameters;

static inline void mote_rom(const mote_rom_parameters *p, int64_t address, int64_t *word) {
  *word = (int64_t)p->File[mote_cut((uint64_t)address, 0, p->AddressWidth)].low;
}

typedef struct {
  int AddressWidth, Width;
  const mote_entry *File;
} mote_rom_pair_parameters;

static inline void mote_rom_pair(const mote_rom_pair_parameters *p, int64_t address0, int64_t address1, int64_t *word0,
                                 int64_t *word1) {
  *word0 = (int64_t)p->File[mote_cut((uint64_t)address0, 0, p->AddressWidth)].low;
  *word1 = (int64_t)p->File[mote_cut((uint64_t)address1, 0, p->AddressWidth)].low;
}

#endif
