// node tests/browser/use_page.mjs SAMPLE.html [FOLDER for screenshots]
//
// Uses the sample page as a reader does: legend, zoom, linked charts, tooltips, keyboard, dark, print.
import assert from "node:assert/strict";
import { join } from "node:path";
import { chromium, inspect, look, withBrowser } from "./inspect.mjs";

const [file, shots] = process.argv.slice(2);
const chart = (page, title) => page.locator(`figure[data-chart="${title}"]`);
const ink = async (page, title) => Object.fromEntries((await page.evaluate(look)).find((c) => c.title === title).ink);
const tip = (page, title) => chart(page, title).locator(".tip").textContent({ timeout: 5000 });
const zoomed = (page, title) => chart(page, title).getByRole("button", { name: "Reset the zoom" }).isEnabled();

/** Asks until the answer is `expected`: the page answers a zoom in its next frame, a busy machine later. */
async function becomes(expected, ask) {
  const end = Date.now() + 5000;
  let got = await ask();
  while (got !== expected && Date.now() < end) {
    await new Promise((wake) => setTimeout(wake, 50));
    got = await ask();
  }
  assert.equal(got, expected);
}

/** The middle of a chart's canvas, scrolled into view. */
async function middle(page, title) {
  const box = chart(page, title).getByRole("img");
  await box.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await box.boundingBox();
  return [x + width / 2, y + height / 2];
}

async function wheel(page, title, delta) {
  await page.mouse.move(...(await middle(page, title)));
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, delta);
  await page.keyboard.up("Control");
}

const uses = {
  "a legend entry hides and shows its series": async (page) => {
    const entry = chart(page, "State x").getByRole("button", { name: "observation" });
    assert.ok((await ink(page, "State x")).observation > 100);
    await entry.press("Enter");
    assert.equal((await ink(page, "State x")).observation, 0);
    assert.equal(await entry.getAttribute("aria-pressed"), "false");
    await entry.press("Enter");
    assert.ok((await ink(page, "State x")).observation > 100);
  },
  "the wheel zooms with Ctrl only, and charts of the same x follow": async (page) => {
    await page.mouse.move(...(await middle(page, "State x")));
    await page.mouse.wheel(0, -10);
    assert.equal(await zoomed(page, "State x"), false);
    await wheel(page, "State x", -300);
    await becomes(true, () => zoomed(page, "State x"));
    await becomes(true, () => zoomed(page, "Effective sample size"));
    assert.equal(await zoomed(page, "100 000 points"), false);
    if (shots) await page.screenshot({ path: join(shots, "zoomed.png"), fullPage: true });
    await page.mouse.dblclick(...(await middle(page, "State x")));
    await becomes(false, () => zoomed(page, "Effective sample size"));
  },
  "buttons zoom, also in the plane": async (page) => {
    for (const title of ["Track", "Error against work"]) {
      await chart(page, title).getByRole("button", { name: "Zoom in" }).click();
      assert.equal(await zoomed(page, title), true);
      await chart(page, title).getByRole("button", { name: "Zoom out" }).click();
      assert.equal(await zoomed(page, title), false);
    }
  },
  "bars are told by their rows": async (page) => {
    await page.mouse.move(...(await middle(page, "Stages at work"))); // about 4.5 ms
    const text = await tip(page, "Stages at work");
    for (const part of ["propose 1", "4 … 6", "weigh 1", "2 … 5", "weigh 2", "4 … 7"]) assert.ok(text.includes(part), text);
    const entry = chart(page, "Stages at work").getByRole("button", { name: "weigh" });
    assert.ok((await ink(page, "Stages at work")).weigh > 1000);
    await entry.press("Enter");
    assert.equal((await ink(page, "Stages at work")).weigh, 0);
    await entry.press("Enter");
  },
  "the tooltip tells the values, names as text": async (page) => {
    await page.mouse.move(...(await middle(page, "State x")));
    const text = await tip(page, "State x");
    assert.match(text, /t \(step\) = \d+/);
    for (const name of ["estimate ± 2 sd", "estimate", "observation", "truth"]) assert.ok(text.includes(name), text);
    if (shots) await page.screenshot({ path: join(shots, "tooltip.png") });
  },
  "the tooltip of the plane tells the nearest point": async (page) => {
    const [x, y] = await middle(page, "Track");
    await page.mouse.move(x + 20, y - 22);
    await page.mouse.move(x + 22, y - 22);
    assert.match(await tip(page, "Track"), /x \(km\) = .*(estimate|truth)/);
    if (shots) await page.screenshot({ path: join(shots, "plane.png") });
  },
  "100 000 points are drawn again within a second": async (page) => {
    await wheel(page, "100 000 points", -200);
    const button = chart(page, "100 000 points").getByRole("button", { name: "Zoom out" });
    const milliseconds = await button.evaluate((node) => {
      const start = performance.now();
      node.click();
      return performance.now() - start;
    });
    console.log(`        ${milliseconds.toFixed(0)} ms`);
    assert.ok(milliseconds < 1000);
  },
  "dark and paper repaint the charts": async (page) => {
    const drawn = async () => Object.values(await ink(page, "State x")).every((count) => count > 100);
    await page.emulateMedia({ colorScheme: "dark" });
    await becomes(true, drawn);
    await page.evaluate(() =>
      addEventListener("beforeprint", () => (window.paperWidth = document.querySelector("canvas").style.width)),
    );
    await page.pdf({ format: "A4", ...(shots && { path: join(shots, "print.pdf") }) });
    assert.equal(await page.evaluate("paperWidth"), "672px");
    await becomes(true, drawn);
    await page.emulateMedia({ colorScheme: "light" });
    await becomes(true, drawn);
  },
  "everything has a name": async (page) => {
    const nameless = await page.evaluate(
      () =>
        [...document.querySelectorAll("button, [role=img], figure")].filter(
          (node) => !(node.getAttribute("aria-label") ?? node.textContent).trim(),
        ).length,
    );
    assert.equal(nameless, 0);
    assert.match(
      await chart(page, "Track").getByRole("img").getAttribute("aria-label"),
      /^Track: plot of estimate, truth; x \(km\) from /,
    );
  },
  "nothing is wider than a narrow screen": async (page) => {
    await page.setViewportSize({ width: 360, height: 700 });
    await becomes(360, () => page.evaluate(() => document.documentElement.scrollWidth));
  },
};

if (!chromium()) {
  console.log("skipped: no Chromium found; install the package chromium or set MOTE_CHROMIUM");
  process.exit(77);
}
const failed = [];
async function useAll(page) {
  for (const [name, use] of Object.entries(uses)) {
    try {
      await use(page);
      console.log(`passed  ${name}`);
    } catch (error) {
      failed.push(name);
      console.log(`FAILED  ${name}: ${error.message}`);
    }
  }
}
const { failures } = await withBrowser((browser) => inspect(browser, file, { expectCharts: 7, use: useAll }));
failures.forEach((failure) => console.log(`FAILED  ${failure}`));
process.exit(failed.length + failures.length ? 1 : 0);
