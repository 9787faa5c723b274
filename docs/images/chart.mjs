// node docs/images/chart.mjs REPORT.html CHART OUT.png
//
// Takes the picture of one chart of a report in headless Chromium (./check installs it and the driver).
import { pathToFileURL } from "node:url";
import { resolve } from "node:path";
import { withBrowser } from "../../tests/browser/inspect.mjs";

const [report, chart, out] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const page = await browser.newPage({ viewport: { width: 860, height: 700 }, colorScheme: "light" });
  await page.goto(pathToFileURL(resolve(report)).href);
  await page.waitForTimeout(500);
  await page.addStyleTag({ content: "figure button:not(.legend button) { visibility: hidden }" });
  const box = await page.locator(`[data-chart="${chart}"]`).boundingBox();
  const clip = { x: box.x - 12, y: box.y - 8, width: box.width + 24, height: box.height + 8 };
  await page.screenshot({ path: out, clip, fullPage: true });
});
