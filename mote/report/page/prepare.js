// From the page's data to what is drawn: log axes taken, points sorted, ranges known. Done once per chart.

const toPosition = (log) => (v) => (v === null ? NaN : log ? (v > 0 ? Math.log10(v) : NaN) : v);

/** [least, greatest] finite value of several arrays; [Infinity, -Infinity] if there is none. */
export function extent(arrays) {
  let low = Infinity;
  let high = -Infinity;
  for (const values of arrays)
    for (const v of values) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
  return [low, high];
}

function isSorted(x) {
  for (let i = 1; i < x.length; ++i) if (!(x[i] >= x[i - 1])) return false;
  return true;
}

/** The same rows with x growing and without those that have no x: what searching and thinning need. */
function sortedRows(columns) {
  const order = Array.from(columns.x.keys()).filter((i) => Number.isFinite(columns.x[i]));
  order.sort((a, b) => columns.x[a] - columns.x[b]);
  return Object.fromEntries(Object.entries(columns).map(([name, v]) => [name, Float64Array.from(order, (i) => v[i])]));
}

function positions(item, names, chart) {
  const take = (name) => Float64Array.from(item[name], toPosition(name === "x" ? chart.log_x : chart.log_y));
  return Object.fromEntries(names.map((name) => [name, take(name)]));
}

/** How many numbers a logarithmic axis cannot show. */
function hiddenByLog(items, names, log) {
  if (!log) return 0;
  return items
    .flatMap((item) => names.filter((n) => item[n]).map((n) => item[n].filter((v) => v !== null && v <= 0).length))
    .reduce((sum, n) => sum + n, 0);
}

const isTruth = (item) => item.name.trim().toLowerCase() === "truth";

/** How much of its row a bar fills, to either side of the middle. */
const barHalf = 0.36;

/** Bars as bands of their rows: x where they begin, growing, and where they end. */
function preparedBars(item) {
  const { x, end, row } = sortedRows({ x: item.begin, end: item.end, row: item.row });
  return { name: item.name, mark: "bars", x, end, row, low: row.map((r) => r - barHalf), high: row.map((r) => r + barHalf) };
}

/** Colour numbers: series in order (truth has its own, -1); a band takes that of the series its name starts with. */
function numberColours(series, bands, bars) {
  let next = 0;
  for (const item of [...series, ...bars]) item.colour = isTruth(item) ? -1 : next++;
  for (const band of bands) {
    const owner = series.find((item) => item.colour >= 0 && item.name && band.name.startsWith(item.name));
    band.colour = owner ? owner.colour : next++;
  }
}

/**
 * A chart ready to draw. `plane`: some line turns back in x (or the axes are equal, or points have labels), so nearness
 * is in the plane; otherwise every x array grows. x, y: full ranges; whole: all x are whole numbers; hidden: numbers lost
 * to log axes.
 */
export function prepare(chart) {
  const line = (item) => item.mark !== "points";
  const series = chart.series.map((item) => ({
    name: item.name,
    mark: item.mark,
    truth: isTruth(item),
    labels: item.labels ?? [],
    ...positions(item, ["x", "y"], chart),
  }));
  const bands = chart.bands.map((item) => ({
    name: item.name,
    mark: "band",
    ...positions(item, ["x", "low", "high"], chart),
  }));
  const plane =
    chart.equal_axes ||
    series.some(
      (item) => item.labels.length || (line(item) && !isSorted(item.x.filter((v) => !Number.isNaN(v)))),
    );
  for (const item of [...bands, ...series])
    if (item.mark === "band" || !plane)
      Object.assign(
        item,
        sortedRows(item.mark === "band" ? { x: item.x, low: item.low, high: item.high } : { x: item.x, y: item.y }),
      );
  const bars = (chart.bars ?? []).map(preparedBars);
  const rows = chart.rows ?? [];
  numberColours(series, bands, bars);
  const items = [...bands, ...bars, ...series];
  return {
    ...chart,
    series,
    bands,
    items,
    rows,
    plane,
    xRange: extent(items.flatMap((item) => (item.end ? [item.x, item.end] : [item.x]))),
    yRange: rows.length
      ? [-0.5, rows.length - 0.5]
      : extent(items.flatMap((item) => (item.y ? [item.y] : [item.low, item.high]))),
    whole: !chart.log_x && items.every((item) => item.x.every((v) => Number.isInteger(v) || Number.isNaN(v))),
    hidden:
      hiddenByLog([...chart.series, ...chart.bands], ["x"], chart.log_x) +
      hiddenByLog([...chart.series, ...chart.bands], ["y", "low", "high"], chart.log_y),
  };
}
