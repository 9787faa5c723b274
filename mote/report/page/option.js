// One chart as an ECharts option. Ranges and ticks are ours (they are known exactly); ECharts draws and zooms.
import { tickLabel, ticks } from "./scale.js";

export const margins = { left: 82, right: 26, top: 12, bottom: 46 };

export const colourOf = (item, colours) =>
  item.truth ? colours.ink : colours.colours[item.colour % colours.colours.length];

// More series than colours: the second round is told apart by its dashes and diamonds.
const isSecondRound = (item, colours) => item.colour >= colours.colours.length;
const dash = (item, colours) => (item.truth ? [6, 4] : isSecondRound(item, colours) ? [2, 3] : "solid");

function axis({ name, full, shown, log, whole, count, gap, place, empty, colours, rows = [] }) {
  const marks = rows.length ? [...rows.keys()] : ticks(shown, count, { log, whole });
  const text = { color: colours.soft, fontFamily: colours.font, fontSize: 12 };
  return {
    type: "value",
    name,
    nameLocation: "middle",
    nameGap: gap,
    nameTextStyle: { ...text, color: colours.ink, fontSize: 13 },
    min: full[0],
    max: full[1],
    position: place,
    inverse: rows.length > 0,
    axisLine: { show: true, onZero: false, lineStyle: { color: colours.line } },
    axisTick: { show: true, customValues: marks, lineStyle: { color: colours.line } },
    axisLabel: {
      ...text,
      show: !empty,
      customValues: marks,
      hideOverlap: true,
      formatter: (v) => (rows.length ? (rows[v] ?? "") : tickLabel(v, shown, log)),
    },
    splitLine: { show: true, lineStyle: { color: colours.grid, width: 1 } },
    axisPointer: { label: { show: false }, lineStyle: { color: colours.soft, type: "solid", width: 1 } },
  };
}

/** Runs of points without NaN. */
function runs(points) {
  const all = [[]];
  for (const point of points) {
    if (Number.isNaN(point[1]) || Number.isNaN(point[2])) all.push([]);
    else all.at(-1).push(point);
  }
  return all.filter((run) => run.length);
}

function bandSeries(item, points, colours) {
  const outline = (api, run) => [
    ...run.map(([x, low]) => api.coord([x, low])),
    ...run.map(([x, , high]) => api.coord([x, high])).reverse(),
  ];
  const style = { fill: colourOf(item, colours), opacity: 0.22 };
  // A run of one point has no area: it is shown as a bar.
  const shape = (api, run) =>
    run.length > 1
      ? { type: "polygon", shape: { points: outline(api, run) }, style, silent: true }
      : {
          type: "polyline",
          shape: { points: outline(api, run) },
          style: { ...style, fill: "none", stroke: style.fill, lineWidth: 3 },
          silent: true,
        };
  return {
    type: "custom",
    clip: true,
    z: 1,
    silent: true,
    data: points,
    dimensions: ["x", "low", "high"],
    encode: { x: 0, y: [1, 2] },
    renderItem: (params, api) =>
      params.dataIndex === 0
        ? { type: "group", children: runs(points).map((run) => shape(api, run)) }
        : { type: "group", children: [] },
  };
}

function barSeries(item, points, colours) {
  const fill = colourOf(item, colours);
  return {
    type: "custom",
    clip: true,
    z: 2,
    silent: true,
    data: points,
    dimensions: ["begin", "low", "high", "end"],
    encode: { x: [0, 3], y: [1, 2] },
    renderItem: (params, api) => {
      const [left, top] = api.coord([api.value(0), api.value(1)]);
      const [right, bottom] = api.coord([api.value(3), api.value(2)]);
      // a hairline of ground tells a bar from the next
      const width = Math.max(0.7, right - left > 4 ? right - left - 1 : right - left);
      return { type: "rect", shape: { x: left, y: top, width, height: bottom - top }, style: { fill }, silent: true };
    },
  };
}

/** A point between two gaps has no line to be seen by: it gets a dot. */
function withLonelyDots(points, size) {
  const gap = (p) => !p || Number.isNaN(p[0]) || Number.isNaN(p[1]);
  return points.map((p, i) =>
    !gap(p) && gap(points[i - 1]) && gap(points[i + 1]) ? { value: p, symbol: "circle", symbolSize: size } : p,
  );
}

function lineSeries(item, points, colours) {
  const color = colourOf(item, colours);
  return {
    type: "line",
    clip: true,
    z: item.truth ? 4 : 3,
    silent: true,
    data: withLonelyDots(points, 5),
    step: item.mark === "steps" ? "end" : false,
    symbol: item.mark === "marked" ? "circle" : "none",
    symbolSize: 7,
    showSymbol: true,
    showAllSymbol: true,
    connectNulls: false,
    itemStyle: { color },
    lineStyle: { color, width: item.truth ? 1.6 : 1.8, type: dash(item, colours), join: "round" },
    emphasis: { disabled: true },
  };
}

function pointSeries(item, points, colours) {
  const many = points.length > 2000;
  return {
    type: "scatter",
    clip: true,
    z: 2,
    silent: true,
    data: points,
    large: many,
    progressive: 0,
    symbol: isSecondRound(item, colours) ? "diamond" : "circle",
    symbolSize: many ? 2.5 : points.length > 300 ? 4 : points.length > 3 ? 5.5 : 10,
    itemStyle: { color: colourOf(item, colours), opacity: many ? 0.6 : 0.85 },
    emphasis: { disabled: true },
  };
}

const seriesOf = { band: bandSeries, bars: barSeries, points: pointSeries, line: lineSeries, steps: lineSeries, marked: lineSeries };

/**
 * chart: prepared; shown: [{item, points}]; full, window: {x, y} ranges; size: of the whole canvas; tooltip: ours.
 */
export function option(chart, shown, full, window, [width, height], colours, tooltip) {
  const zoom = (id, which, range) => ({
    id,
    type: "inside",
    [which]: 0,
    startValue: range[0],
    endValue: range[1],
    filterMode: "none",
    minSpan: 0.001,
    zoomOnMouseWheel: "ctrl",
    moveOnMouseMove: true,
    preventDefaultMouseMove: false,
  });
  const across = Math.max(3, Math.round(width / 90));
  const empty = !(chart.xRange[0] <= chart.xRange[1] && chart.yRange[0] <= chart.yRange[1]);
  const up = Math.max(3, Math.round(height / 60));
  const common = { empty, colours };
  const x = {
    ...common,
    name: chart.x_label,
    full: full.x,
    shown: window.x,
    log: chart.log_x,
    whole: chart.whole,
    count: across,
    gap: 28,
    place: "bottom",
  };
  const y = {
    ...common,
    name: chart.y_label,
    full: full.y,
    shown: window.y,
    log: chart.log_y,
    whole: false,
    count: up,
    gap: 64,
    place: "left",
    rows: chart.rows,
  };
  return {
    animation: false,
    grid: { ...margins, outerBoundsMode: "none", show: true, borderColor: colours.line, borderWidth: 1 },
    xAxis: axis(x),
    yAxis: axis(y),
    dataZoom: [zoom("x", "xAxisIndex", window.x), ...(chart.plane ? [zoom("y", "yAxisIndex", window.y)] : [])],
    tooltip: {
      confine: true,
      transitionDuration: 0,
      backgroundColor: colours.ground,
      borderColor: colours.line,
      padding: 0,
      ...tooltip,
    },
    series: shown.map(({ item, points }) => seriesOf[item.mark](item, points, colours)),
  };
}
