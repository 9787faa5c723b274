// What the tooltip says: values from the full data, not from the thinned points on the screen.
import { lowerBound } from "./thin.js";
import { formatted, valueAt } from "./scale.js";

/** Index of the x (growing) nearest to `value`, -1 if there is none within `reach`. */
function nearest(x, value, reach) {
  const after = lowerBound(x, value);
  const candidates = [after - 1, after].filter((i) => i >= 0 && i < x.length && Math.abs(x[i] - value) <= reach);
  return candidates.sort((a, b) => Math.abs(x[a] - value) - Math.abs(x[b] - value))[0] ?? -1;
}

/** The bars under x: [{item, i}]. */
const barsAt = (item, x) =>
  Array.from(item.x.keys())
    .filter((i) => item.x[i] <= x && x <= item.end[i])
    .map((i) => ({ item, i }));

/** The items of a chart near x: [{item, i}], all at the x nearest to the pointer; all bars under it. */
export function hitsAt(items, x, reach) {
  if (items.some((item) => item.end)) return items.filter((item) => item.end).flatMap((item) => barsAt(item, x));
  const hits = items.map((item) => ({ item, i: nearest(item.x, x, reach) })).filter(({ i }) => i >= 0);
  const distance = ({ item, i }) => Math.abs(item.x[i] - x);
  const least = Math.min(...hits.map(distance));
  return hits.filter((hit) => distance(hit) <= least + 0.25 * reach);
}

/** The one point of a chart in the plane that is nearest to a pixel, if within 24 pixels. */
export function hitNear(items, [px, py], toPixel) {
  let best = { distance: 24 };
  for (const item of items.filter((it) => it.y))
    for (let i = 0; i < item.x.length; ++i) {
      const [qx, qy] = toPixel(item.x[i], item.y[i]);
      const distance = Math.hypot(qx - px, qy - py);
      if (distance < best.distance) best = { distance, item, i, at: [qx, qy] };
    }
  return best.item ? best : null;
}

function element(name, text, className) {
  const node = document.createElement(name);
  node.textContent = text;
  if (className) node.className = className;
  return node;
}

/** The tooltip's element: a heading and one row per hit. Built as text nodes, so names are never markup. */
export function tipElement(chart, hits, swatch) {
  const { item: first, i: at } = hits[0];
  const x = (item, i) => formatted(valueAt(item.x[i], chart.log_x), 7);
  const y = (v) => formatted(valueAt(v, chart.log_y));
  const box = element("div", "", "tip");
  box.append(element("div", first.end ? chart.x_label : `${chart.x_label || "x"} = ${x(first, at)}`, "tip-head"));
  const bar = (item, i) => `${x(item, i)} … ${formatted(valueAt(item.end[i], chart.log_x), 7)}`;
  for (const { item, i } of hits) {
    const row = element("div", "", "tip-row");
    const value = item.end ? bar(item, i) : item.y ? y(item.y[i]) : `${y(item.low[i])} … ${y(item.high[i])}`;
    const name = item.end ? (chart.rows[item.row[i]] ?? item.name) : item.name;
    row.append(swatch(item), element("span", name), element("b", value));
    box.append(row);
    if (item.labels?.[i]) box.append(element("div", item.labels[i], "tip-label"));
  }
  return box;
}
