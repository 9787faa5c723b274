// Ranges, ticks and number formats. A logarithmic axis is a linear one of log10(value): `log` says how to label it.

/** [low, high] widened so that nothing touches the frame; a range without width gets one. */
export function padded([low, high], share) {
  if (!(low <= high)) return [0, 1];
  const width = high - low;
  const margin = width > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) ? width * share : Math.abs(low) * 0.1 || 1;
  return [low - margin, high + margin];
}

/** The step of 1, 2, 5 times a power of ten that comes nearest to `count` intervals. */
function niceStep(width, count) {
  const rough = width / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].find((m) => m * m * power * power >= (rough * rough) / 2.2) * power;
}

function linearTicks([low, high], count, whole) {
  const step = Math.max(niceStep(high - low, count), whole ? 1 : 0);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

/** Tick positions in [low, high], about `count`; `whole`: only whole numbers. Log axes: decades, or 1-2-5 within few. */
export function ticks([low, high], count, { log = false, whole = false } = {}) {
  if (!log) return linearTicks([low, high], count, whole);
  const decades = Array.from({ length: Math.floor(high) - Math.floor(low) + 1 }, (_, i) => Math.floor(low) + i);
  const marks = decades.flatMap((d) => [1, 2, 5].map((m) => d + Math.log10(m))).filter((v) => v >= low && v <= high);
  if (marks.length > 1.6 * count) return linearTicks([low, high], count, true);
  return marks.length >= 2
    ? marks
    : linearTicks([10 ** low, 10 ** high], count, false)
        .filter((v) => v > 0)
        .map(Math.log10);
}

const superscript = (n) => String(n).replace(/[-\d]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);

/** A number to read: at most `digits` significant digits, powers of ten when it is very large or small. */
export function formatted(value, digits = 5) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size === 0 || (size >= 1e-3 && size < 1e6)) return String(Number(value.toPrecision(digits))).replace("-", "−");
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const power = `10${superscript(Number(exponent))}`;
  const factor = String(Number(mantissa)).replace("-", "−");
  return factor === "1" ? power : `${factor}·${power}`;
}

/** The value that stands at `position` of an axis. */
export const valueAt = (position, log) => (log ? 10 ** position : position);

/** The label of a tick: as many digits as tell it from its neighbours. */
export function tickLabel(position, range, log) {
  const span = (range[1] - range[0]) / Math.max(Math.abs(range[0]), Math.abs(range[1]));
  return formatted(valueAt(position, log), log ? 4 : Math.min(12, Math.max(4, 3 - Math.floor(Math.log10(span)))));
}
