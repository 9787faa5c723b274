// node --test page/thin_test.mjs
import assert from "node:assert/strict";
import test from "node:test";
import { prepare } from "./prepare.js";
import { formatted, padded, tickLabel, ticks } from "./scale.js";
import { lowerBound, thinBand, thinLine, thinPoints, thinTrack, visible, visibleBars } from "./thin.js";
import { hitNear, hitsAt } from "./tip.js";

const n = 100000;
const x = Float64Array.from({ length: n }, (_, i) => i);
const noise = Float64Array.from({ length: n }, (_, i) => Math.sin(i * 12.9898) * 0.5);

test("a thinned line keeps every peak and at most five points per pixel", () => {
  const y = noise.slice();
  y[54321] = 99;
  y[12345] = -99;
  const kept = thinLine({ x, y }, [0, n], 800);
  assert.ok(kept.length <= 5 * 801);
  assert.ok(kept.some(([at, v]) => at === 54321 && v === 99));
  assert.ok(kept.some(([at, v]) => at === 12345 && v === -99));
  assert.ok(kept.every(([at], i) => i === 0 || at > kept[i - 1][0]));
});

test("a thinned line keeps a gap, even of one point", () => {
  const y = noise.slice();
  y[777] = NaN;
  assert.equal(thinLine({ x, y }, [0, n], 800).filter(([, v]) => Number.isNaN(v)).length, 1);
  assert.ok(thinLine({ x, y: y.fill(NaN) }, [0, n], 800).every(([, v]) => Number.isNaN(v)));
});

test("a short line is not thinned", () => {
  const short = { x: Float64Array.of(1, 2, 3), y: Float64Array.of(5, NaN, 7) };
  assert.deepEqual(thinLine(short, [1, 3], 800), [
    [1, 5],
    [2, NaN],
    [3, 7],
  ]);
});

test("a window shows one point beyond each side", () => {
  assert.equal(lowerBound(x, 10.5), 11);
  assert.deepEqual(visible(x, [10.5, 12.5]), [10, 14]);
  assert.deepEqual(visible(x, [10, 12]), [9, 14]);
  assert.deepEqual(visible(x, [-5, 1e9]), [0, n]);
});

test("a thinned band contains the band", () => {
  const low = noise.map((v) => v - 1);
  const high = noise.map((v) => v + 1);
  low[4000] = -50;
  high.fill(NaN, 50000, 60000);
  low.fill(NaN, 50000, 60000);
  const kept = thinBand({ x, low, high }, [0, n], 800);
  assert.ok(kept.length <= 2 * 801);
  assert.ok(kept.some(([, v]) => v === -50));
  assert.ok(kept.some(([, v]) => Number.isNaN(v)));
});

test("thinned points cover what the points cover; those outside are left out", () => {
  const kept = thinPoints({ x, y: noise }, [0, n], [-1, 1], [800, 300]);
  assert.ok(kept.length > 1000 && kept.length < 400 * 150);
  assert.equal(thinPoints({ x, y: noise }, [200000, 300000], [-1, 1], [800, 300]).length, 0);
});

test("a thinned track stays within half a pixel, keeps its end and its gaps", () => {
  const angle = x.map((i) => i / 2000);
  const track = { x: angle.map(Math.cos), y: angle.map(Math.sin) };
  track.y[30000] = NaN;
  const kept = thinTrack(track, [-1, 1], [-1, 1], [400, 400]);
  assert.ok(kept.length < n / 2);
  assert.deepEqual(kept.at(-1), [track.x[n - 1], track.y[n - 1]]);
  assert.ok(kept.some(([, v]) => Number.isNaN(v)));
});

test("ticks are round, inside, and whole where asked", () => {
  assert.deepEqual(ticks([0, 10], 5), [0, 2, 4, 6, 8, 10]);
  assert.deepEqual(ticks([0.9, 3.1], 10, { whole: true }), [1, 2, 3]);
  assert.deepEqual(ticks([0, 3], 4, { log: true }), [0, 1, 2, 3]);
  assert.equal(ticks([0, 3], 10, { log: true }).length, 10);
  assert.equal(ticks([0, 1], 10, { log: true }).length, 4);
  assert.ok(ticks([0.301, 0.302], 5, { log: true }).length >= 2);
});

test("numbers are readable", () => {
  assert.equal(formatted(-0.5), "−0.5");
  assert.equal(formatted(1e9), "10⁹");
  assert.equal(formatted(2.5e-7), "2.5·10⁻⁷");
  assert.equal(formatted(NaN), "–");
  assert.equal(tickLabel(1.7e9 + 20, [1.7e9, 1.7e9 + 100], false), "1.70000002·10⁹");
  assert.deepEqual(padded([3, 3], 0.1), [2.7, 3.3]);
  assert.deepEqual(padded([Infinity, -Infinity], 0.1), [0, 1]);
});

const chart = (more) => ({
  title: "",
  x_label: "t",
  y_label: "",
  log_x: false,
  log_y: false,
  equal_axes: false,
  bands: [],
  series: [],
  ...more,
});

test("log axes count what they cannot show; nulls are gaps", () => {
  const ready = prepare(
    chart({ log_y: true, series: [{ name: "a", mark: "line", x: [1, 2, 3, 4], y: [100, 0, -1, null] }] }),
  );
  assert.equal(ready.hidden, 2);
  assert.equal(ready.series[0].y[0], 2);
  assert.deepEqual(ready.yRange, [2, 2]);
});

test("a line that turns back makes a chart of the plane, unsorted points do not", () => {
  const item = (mark) => ({ name: "a", mark, x: [1, 3, 2], y: [1, 2, 3] });
  assert.equal(prepare(chart({ series: [item("line")] })).plane, true);
  const points = prepare(chart({ series: [item("points")] }));
  assert.equal(points.plane, false);
  assert.deepEqual([...points.series[0].y], [1, 3, 2]);
});

test("points with labels are found one by one, as they were given", () => {
  const series = [{ name: "a", mark: "points", x: [3, 1, 2], y: [1, 2, 3], labels: ["c", "a", "b"] }];
  const ready = prepare(chart({ series }));
  assert.equal(ready.plane, true);
  const hit = hitNear(ready.items, [101, 199], (x, y) => [100 * x, 100 * y]);
  assert.equal(hit.item.labels[hit.i], "a");
});

test("a band takes the colour of its series, truth has its own", () => {
  const line = (name) => ({ name, mark: "line", x: [], y: [] });
  const { series, bands } = prepare(
    chart({
      series: [line("truth"), line("a"), line("x")],
      bands: [
        { name: "x ± 2 sd", x: [], low: [], high: [] },
        { name: "other", x: [], low: [], high: [] },
      ],
    }),
  );
  assert.deepEqual(
    series.map((s) => s.colour),
    [-1, 0, 1],
  );
  assert.deepEqual(
    bands.map((b) => b.colour),
    [1, 2],
  );
});

test("bars are rows from the top, coloured by name, found by what they cover", () => {
  const ready = prepare(
    chart({
      rows: ["a 1", "a 2"],
      bars: [
        { name: "a", begin: [3, 0], end: [9, 2], row: [1, 0] },
        { name: "b", begin: [4], end: [5], row: [0] },
      ],
    }),
  );
  const [a, b] = ready.items;
  assert.deepEqual([...a.x], [0, 3]);
  assert.deepEqual([...a.end], [2, 9]);
  assert.deepEqual([a.colour, b.colour], [0, 1]);
  assert.deepEqual(ready.xRange, [0, 9]);
  assert.deepEqual(ready.yRange, [-0.5, 1.5]);
  assert.deepEqual(visibleBars(a, [2.5, 4]), [[3, a.low[1], a.high[1], 9]]);
  assert.deepEqual(visibleBars(a, [1, 1]), [[0, a.low[0], a.high[0], 2]]);
  assert.deepEqual(
    hitsAt([a, b], 4.5, 0.1).map(({ item, i }) => [item.name, i]),
    [
      ["a", 1],
      ["b", 0],
    ],
  );
});

test("the tooltip gathers what is at one x", () => {
  const items = [{ x: Float64Array.of(1, 2, 3) }, { x: Float64Array.of(2, 4) }];
  assert.deepEqual(
    hitsAt(items, 2.1, 0.5).map(({ i }) => i),
    [1, 0],
  );
  assert.deepEqual(hitsAt(items, 9, 0.5), []);
});
