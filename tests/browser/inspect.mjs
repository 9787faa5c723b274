// Opens a page in headless Chromium and reports everything that is wrong with it.
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const flags = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** The browser to use (MOTE_CHROMIUM, else the usual places); undefined if there is none. */
export function chromium() {
  const names = ["chromium", "chromium-browser", "google-chrome"];
  const folders = ["/usr/bin", ...(process.env.PATH ?? "").split(":")];
  const usual = folders.flatMap((folder) => names.map((name) => join(folder, name)));
  return (process.env.MOTE_CHROMIUM ? [process.env.MOTE_CHROMIUM] : usual).find((file) => existsSync(file));
}

/** playwright-core, from where the build installed it (MOTE_BROWSER_MODULES, else build/tests/browser). */
function playwright() {
  const repository = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
  const folder = process.env.MOTE_BROWSER_MODULES ?? join(repository, "build/tests/browser");
  return createRequire(join(resolve(folder), "package.json"))("playwright-core");
}

/** Calls use(browser) with a browser of its own, with a fresh profile that is removed afterwards. */
export async function withBrowser(use) {
  const browser = await playwright().chromium.launch({ executablePath: chromium(), headless: true, args: flags });
  try {
    return await use(browser);
  } finally {
    await browser.close();
  }
}

/** Notes every error and every request but the page's own file in `failures`. */
function listen(page, url, failures) {
  page.on("pageerror", (error) => failures.push(`page error: ${error.message}`));
  page.on("console", (message) => message.type() === "error" && failures.push(`console error: ${message.text()}`));
  page.on("requestfailed", (request) => failures.push(`failed request: ${request.url().slice(0, 200)}`));
  page.on("request", (request) => {
    const own = request.url() === url || request.url().startsWith("data:");
    if (!own) failures.push(`request to outside the page: ${request.url().slice(0, 200)}`);
  });
}

/**
 * Runs in the page. For each chart: its title, whether it says that it is drawn, whether it claims to have no data, and
 * how many pixels have the colour of each series of the legend (bands and points are mixed with the ground).
 */
export function look() {
  const ground = getComputedStyle(document.documentElement).backgroundColor;
  const rgb = (text) =>
    text
      .match(/[\d.]+/g)
      .slice(0, 3)
      .map(Number);
  const shares = { band: [0.22], points: [0.6, 0.84, 0.85, 0.94, 0.98, 1], line: [1], steps: [1] };
  const colours = (entry) => {
    const full = rgb(getComputedStyle(entry.querySelector(".swatch")).color);
    return (shares[entry.dataset.mark] ?? [1]).map((share) =>
      full.map((c, i) => share * c + (1 - share) * rgb(ground)[i]),
    );
  };
  /** How often each colour occurs in the layers of a chart on the ground, as the reader sees them: [[r, g, b], count]. */
  const histogram = (figure) => {
    const layers = [...figure.querySelectorAll("canvas")];
    if (!layers.length) return [];
    const flat = Object.assign(document.createElement("canvas"), { width: layers[0].width, height: layers[0].height });
    const pen = flat.getContext("2d");
    pen.fillStyle = ground;
    pen.fillRect(0, 0, flat.width, flat.height);
    layers.forEach((layer) => pen.drawImage(layer, 0, 0));
    const counts = new Map();
    for (const pixel of new Uint32Array(pen.getImageData(0, 0, flat.width, flat.height).data.buffer))
      counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
    return [...counts].map(([pixel, n]) => [[pixel & 255, (pixel >> 8) & 255, (pixel >> 16) & 255], n]);
  };
  const near = (a, b) => a.reduce((sum, c, i) => sum + Math.abs(c - b[i]), 0) <= 15;
  const count = (seen, wanted) =>
    seen.filter(([rgb]) => wanted.some((colour) => near(rgb, colour))).reduce((sum, [, n]) => sum + n, 0);
  return [...document.querySelectorAll("[data-chart]")].map((figure) => {
    const seen = histogram(figure);
    const ink = [...figure.querySelectorAll(".legend button")].map((entry) => [
      entry.textContent,
      count(seen, colours(entry)),
    ]);
    return {
      title: figure.dataset.chart,
      rendered: figure.dataset.rendered === "true",
      empty: figure.dataset.empty === "true",
      ink,
    };
  });
}

function judge(charts, expected, failures) {
  if (expected !== undefined && charts.length !== expected)
    failures.push(`expected ${expected} charts, found ${charts.length}`);
  for (const { title, rendered, empty, ink } of charts) {
    if (!rendered) failures.push(`chart "${title}": not rendered`);
    else if (!empty && !ink.some(([, count]) => count >= 8))
      failures.push(`chart "${title}": blank, no pixel has the colour of a series`);
  }
}

/**
 * Opens a file and returns {failures, charts}. options: expectCharts, screenshot (PNG of the whole page), width, height,
 * dark, use(page): what else to do before the judgement.
 */
export async function inspect(browser, file, options = {}) {
  const url = pathToFileURL(resolve(file)).href;
  const context = await browser.newContext({
    viewport: { width: options.width ?? 1200, height: options.height ?? 900 },
    colorScheme: options.dark ? "dark" : "light",
  });
  const failures = [];
  try {
    const page = await context.newPage();
    listen(page, url, failures);
    await page.goto(url, { waitUntil: "load", timeout: 60000 });
    await page.waitForTimeout(300);
    await options.use?.(page, failures);
    const charts = await page.evaluate(look);
    judge(charts, options.expectCharts, failures);
    const told = await page.locator("#page-error, figure .error").allTextContents();
    told.forEach((text) => failures.push(`the page says: ${text}`));
    if (options.screenshot) await page.screenshot({ path: options.screenshot, fullPage: true });
    return { failures, charts };
  } finally {
    await context.close();
  }
}
