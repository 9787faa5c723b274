// What a screen can show of a long series: never more than a few points per pixel column, and never a peak less.

/** First index with x[i] >= value, for growing x. */
export function lowerBound(x, value) {
  let low = 0;
  let high = x.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (x[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Indices [from, to) inside the window and one beyond on each side, so that lines run to the frame. */
export function visible(x, [low, high]) {
  let to = lowerBound(x, high);
  while (to < x.length && x[to] <= high) ++to;
  return [Math.max(0, lowerBound(x, low) - 1), Math.min(x.length, to + 1)];
}

/** Calls column(from, to) for the runs of points that share a pixel column. */
function eachColumn(x, [from, to], window, pixels, column) {
  const scale = pixels / (window[1] - window[0]);
  const pixel = (i) => Math.floor((x[i] - window[0]) * scale);
  for (let i = from; i < to;) {
    let end = i + 1;
    while (end < to && pixel(end) === pixel(i)) ++end;
    column(i, end);
    i = end;
  }
}

/** A line: of each column the first, least, greatest and last point, and a gap if it has one. */
export function thinLine({ x, y }, window, pixels) {
  const [from, to] = visible(x, window);
  const kept = [];
  eachColumn(x, [from, to], window, pixels, (a, b) => {
    let least = a,
      greatest = a,
      gap = -1;
    for (let i = a; i < b; ++i) {
      if (Number.isNaN(y[i])) gap = i;
      if (!(y[i] >= y[least])) least = Number.isNaN(y[i]) ? least : i;
      if (!(y[i] <= y[greatest])) greatest = Number.isNaN(y[i]) ? greatest : i;
    }
    const some = b - a <= 5 ? Array.from({ length: b - a }, (_, i) => a + i) : [a, least, greatest, gap, b - 1];
    const order = [...new Set(some)].filter((i) => i >= 0).sort((p, q) => p - q);
    for (const i of order) kept.push([x[i], y[i]]);
  });
  return kept;
}

/** A band: of each column the least low and the greatest high; NaN only where a whole column is missing. */
export function thinBand({ x, low, high }, window, pixels) {
  const kept = [];
  eachColumn(x, visible(x, window), window, pixels, (a, b) => {
    if (b - a <= 2) {
      for (let i = a; i < b; ++i) kept.push([x[i], low[i], high[i]]);
      return;
    }
    let least = Infinity,
      greatest = -Infinity;
    for (let i = a; i < b; ++i) {
      if (low[i] < least) least = low[i];
      if (high[i] > greatest) greatest = high[i];
    }
    const there = least <= greatest;
    kept.push([(x[a] + x[b - 1]) / 2, there ? least : NaN, there ? greatest : NaN]);
  });
  return kept;
}

/** Points: one of those that would be painted over each other, in cells of 2 pixels. */
export function thinPoints({ x, y }, xWindow, yWindow, [width, height]) {
  const seen = new Set();
  const kept = [];
  const cells = (low, high, pixels) => (v) => Math.floor(((v - low) / (high - low)) * (pixels / 2));
  const column = cells(...xWindow, width);
  const row = cells(...yWindow, height);
  for (let i = 0; i < x.length; ++i) {
    const outside = !(x[i] >= xWindow[0] && x[i] <= xWindow[1] && y[i] >= yWindow[0] && y[i] <= yWindow[1]);
    const cell = column(x[i]) * 65536 + row(y[i]);
    if (outside || seen.has(cell)) continue;
    seen.add(cell);
    kept.push([x[i], y[i]]);
  }
  return kept;
}

/** Bars: those that reach into the window, as [begin, low, high, end]. */
export function visibleBars({ x, end, low, high }, [first, last]) {
  const kept = [];
  for (let i = 0; i < x.length; ++i)
    if (x[i] <= last && end[i] >= first) kept.push([x[i], low[i], high[i], end[i]]);
  return kept;
}

/** A track: points less than half a pixel from the last kept one are left out; gaps stay. */
export function thinTrack({ x, y }, xWindow, yWindow, [width, height]) {
  const sx = width / (xWindow[1] - xWindow[0]);
  const sy = height / (yWindow[1] - yWindow[0]);
  const kept = [];
  let last = [NaN, NaN];
  for (let i = 0; i < x.length; ++i) {
    const near = Math.hypot((x[i] - last[0]) * sx, (y[i] - last[1]) * sy) < 0.5;
    if (near && i + 1 < x.length) continue;
    last = [x[i], y[i]];
    kept.push(last);
  }
  return kept;
}
