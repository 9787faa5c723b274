// One chart on the page: its buttons, its legend, its canvas, and what happens when the reader zooms.
import { CustomChart, LineChart, ScatterChart } from "echarts/charts";
import { DataZoomInsideComponent, GridComponent, TooltipComponent } from "echarts/components";
import { init, use } from "echarts/core";
import { CanvasRenderer } from "echarts/renderers";
import { margins, option } from "./option.js";
import { extent } from "./prepare.js";
import { formatted, padded, valueAt } from "./scale.js";
import { thinBand, thinLine, thinPoints, thinTrack, visible, visibleBars } from "./thin.js";
import { theme } from "./theme.js";
import { hitNear, hitsAt, tipElement } from "./tip.js";
import { button, legend, swatch } from "./parts.js";

use([CanvasRenderer, LineChart, ScatterChart, CustomChart, GridComponent, TooltipComponent, DataZoomInsideComponent]);

export class Plot {
  /** chart: prepared; zoomed(plot): called when the reader changes the window along x. */
  constructor(figure, chart, zoomed) {
    Object.assign(this, { figure, chart, zoomed, hiddenItems: new Set(), window: null, colours: theme() });
    this.build();
    this.canvas = init(this.box, null, { renderer: "canvas", devicePixelRatio: Math.max(2, devicePixelRatio) });
    this.canvas.on("datazoom", (event) => this.follow(event.batch ?? [event]));
    this.canvas.getZr().on("dblclick", () => this.zoomTo(null));
    if (chart.plane) this.watchPointer();
    this.draw();
    new ResizeObserver(() => this.resize()).observe(this.box);
  }

  build() {
    const { chart, figure } = this;
    const tools = document.createElement("div");
    tools.className = "tools";
    tools.append(
      button("−", `Zoom out: ${chart.title}`, () => this.scale(2)),
      button("+", `Zoom in: ${chart.title}`, () => this.scale(0.5)),
    );
    this.reset = button("Reset", `Reset the zoom: ${chart.title}`, () => this.zoomTo(null));
    tools.append(this.reset);
    this.box = document.createElement("div");
    this.box.className = "plot";
    figure.classList.toggle("plane", chart.equal_axes);
    figure.classList.toggle("empty", this.empty);
    this.box.setAttribute("role", "img");
    this.box.setAttribute("aria-label", this.description());
    figure.append(
      tools,
      legend(chart.items, (item, shown) => this.toggle(item, shown)),
      this.box,
    );
    const remark = this.remark();
    if (remark) figure.append(Object.assign(document.createElement("p"), { className: "remark", textContent: remark }));
  }

  get empty() {
    return !(this.chart.xRange[0] <= this.chart.xRange[1] && this.chart.yRange[0] <= this.chart.yRange[1]);
  }

  remark() {
    const { hidden } = this.chart;
    if (this.empty) return "No data.";
    return hidden
      ? `${hidden} ${hidden === 1 ? "value is" : "values are"} not positive and cannot be shown on a logarithmic axis.`
      : "";
  }

  description() {
    const { title, x_label, y_label, items, xRange, yRange, log_x, log_y } = this.chart;
    const from = (range, log) => `${formatted(valueAt(range[0], log))} to ${formatted(valueAt(range[1], log))}`;
    const rows = this.chart.rows;
    const up = rows.length ? `rows ${rows.join(", ")}` : `${y_label || "y"} from ${from(yRange, log_y)}`;
    const ranges = this.empty
      ? "no data"
      : `${x_label || "x"} from ${from(xRange, log_x)}, ${up}`;
    return `${title}: plot of ${items.map((item) => item.name).join(", ") || "nothing"}; ${ranges}`;
  }

  /** The size of the drawing area in pixels. */
  area() {
    const [width, height] = [this.canvas.getWidth(), this.canvas.getHeight()];
    return [
      Math.max(10, width - margins.left - margins.right),
      Math.max(10, height - margins.top - margins.bottom),
    ];
  }

  /** Everything the chart has; with equal axes, widened to the shape of the area. */
  full() {
    const { chart } = this;
    const x = padded(chart.xRange, chart.plane ? 0.05 : 0.01);
    const y = chart.rows.length ? chart.yRange : padded(chart.yRange, 0.06);
    if (!chart.equal_axes) return { x, y };
    const area = this.area();
    const unit = Math.max((x[1] - x[0]) / area[0], (y[1] - y[0]) / area[1]);
    const around = ([low, high], pixels) => [(low + high - unit * pixels) / 2, (low + high + unit * pixels) / 2];
    return { x: around(x, area[0]), y: around(y, area[1]) };
  }

  /** The window now shown. In a plot that is not in the plane, y follows what is visible. */
  windowIn(full, items) {
    const x = this.window?.x ?? full.x;
    if (this.chart.plane) return { x, y: this.window?.y ?? full.y };
    if (this.chart.rows.length) return { x, y: full.y };
    const inside = (item) => (item.y ? [item.y] : [item.low, item.high]).map((v) => v.subarray(...visible(item.x, x)));
    return { x, y: padded(extent(items.flatMap(inside)), 0.06) };
  }

  points(item, window, area) {
    if (item.mark === "bars") return visibleBars(item, window.x);
    if (item.mark === "band") return thinBand(item, window.x, area[0]);
    if (item.mark === "points") return thinPoints(item, window.x, window.y, area);
    return this.chart.plane ? thinTrack(item, window.x, window.y, area) : thinLine(item, window.x, area[0]);
  }

  draw() {
    const full = this.full();
    const items = this.chart.items.filter((item) => !this.hiddenItems.has(item));
    const window = this.windowIn(full, items);
    const area = this.area();
    const shown = items.map((item) => ({ item, points: this.points(item, window, area) }));
    if (!this.chart.plane) full.y = window.y;
    const size = [this.canvas.getWidth(), this.canvas.getHeight()];
    this.canvas.setOption(option(this.chart, shown, full, window, size, this.colours, this.tooltip(items)), {
      replaceMerge: ["series"],
    });
    this.canvas.getZr().flush();
    this.reset.disabled = this.window === null;
    if (this.empty) this.figure.dataset.empty = "true";
    this.figure.dataset.rendered = "true";
  }

  tooltip(items) {
    if (this.chart.plane) return { trigger: "item", triggerOn: "none" };
    const [low, high] = this.window?.x ?? this.chart.xRange;
    const reach = (24 * (high - low || 1)) / this.area()[0];
    const formatter = ([first]) => {
      const hits = hitsAt(items, first.axisValue, reach);
      return hits.length ? tipElement(this.chart, hits, (item) => swatch(item, this.colours)) : "";
    };
    return { trigger: "axis", formatter };
  }

  /** In the plane the tooltip belongs to the nearest point, not to an x. */
  watchPointer() {
    const items = () => this.chart.items.filter((item) => !this.hiddenItems.has(item));
    const toPixel = (x, y) => this.canvas.convertToPixel("grid", [x, y]);
    this.canvas.getZr().on("mousemove", ({ offsetX, offsetY }) => {
      const hit = hitNear(items(), [offsetX, offsetY], linear(toPixel));
      if (!hit) return this.canvas.dispatchAction({ type: "hideTip" });
      const formatter = () => tipElement(this.chart, [hit], (item) => swatch(item, this.colours));
      this.canvas.dispatchAction({ type: "showTip", x: hit.at[0], y: hit.at[1], tooltip: { formatter, content: " " } });
    });
    this.canvas.getZr().on("globalout", () => this.canvas.dispatchAction({ type: "hideTip" }));
  }

  /** A zoom by wheel, drag or pinch: percents of the full ranges become the window. */
  follow(batch) {
    const full = this.full();
    const part = (range, { start, end }) => [start, end].map((p) => range[0] + ((range[1] - range[0]) * p) / 100);
    const window = { ...(this.window ?? (this.chart.plane ? full : { x: full.x })) };
    for (const change of batch) window[change.dataZoomId] = part(full[change.dataZoomId], change);
    const whole = batch.every(({ start, end }) => start < 0.01 && end > 99.99);
    this.later(whole ? null : window);
  }

  /** Zooming is answered once per frame: ECharts takes no new option while it handles an event. */
  later(window) {
    const waiting = this.next !== undefined;
    this.next = window;
    if (waiting) return;
    requestAnimationFrame(() => {
      const next = this.next;
      this.next = undefined;
      this.zoomTo(next);
    });
  }

  /** Shows a window ({x} or {x, y}; null: everything) and tells the charts that zoom along. */
  zoomTo(window) {
    this.window = window;
    this.draw();
    if (!this.chart.plane) this.zoomed(this);
  }

  /** Follows another chart's window along x, as far as this chart reaches. */
  join(x) {
    const [low, high] = this.full().x;
    const common = x && [Math.max(low, x[0]), Math.min(high, x[1])];
    if (common && common[0] >= common[1]) return;
    this.window = common && { x: common };
    this.draw();
  }

  /** Widens or narrows the window about its middle. */
  scale(factor) {
    const full = this.full();
    const now = this.window ?? (this.chart.plane ? full : { x: full.x });
    const half = ([low, high]) => ((high - low) * factor) / 2;
    const resized = ([low, high], [least, most]) => {
      const middle = (low + high) / 2;
      return [Math.max(least, middle - half([low, high])), Math.min(most, middle + half([low, high]))];
    };
    const window = Object.fromEntries(Object.entries(now).map(([axis, range]) => [axis, resized(range, full[axis])]));
    // to 1e-4 of the range, as follow() has it: zooming in and out again may miss the ends by a rounding
    const whole = Object.entries(window).every(([axis, [low, high]]) => {
      const slack = 1e-4 * (full[axis][1] - full[axis][0]);
      return low <= full[axis][0] + slack && high >= full[axis][1] - slack;
    });
    this.zoomTo(whole ? null : window);
  }

  toggle(item, shown) {
    if (shown) this.hiddenItems.delete(item);
    else this.hiddenItems.add(item);
    this.canvas.dispatchAction({ type: "hideTip" }); // it may tell of what goes
    this.draw();
  }

  resize() {
    this.canvas.resize();
    this.draw();
  }

  repaint() {
    this.colours = theme();
    this.resize();
  }
}

/** The affine map of an axis pair from three of its values: thousands of points are mapped at once. */
function linear(map) {
  const [x0, y0] = map(0, 0);
  const [x1, y1] = map(1, 1);
  return (x, y) => [x0 + (x1 - x0) * x, y0 + (y1 - y0) * y];
}
