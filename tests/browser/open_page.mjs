// node tests/browser/open_page.mjs FILE.html [--expect-charts K] [--screenshot OUT.png] [--width W] [--dark]
//
// Opens the page from the disk and fails (exit 1) on any script error, console error, failed request, request to outside
// the file, undrawn or blank chart. Exit 2: wrong use. Exit 77: there is no Chromium.
import { parseArgs } from "node:util";
import { chromium, inspect, withBrowser } from "./inspect.mjs";

const usage =
  "open_page: expected one FILE.html and the options --expect-charts K, --screenshot OUT.png, --width W, --dark";

function command() {
  try {
    const text = { type: "string" };
    const { values, positionals } = parseArgs({
      allowPositionals: true,
      options: { "expect-charts": text, screenshot: text, width: text, dark: { type: "boolean" } },
    });
    if (positionals.length !== 1) throw new Error(`got ${positionals.length} files`);
    const number = (name) => (values[name] === undefined ? undefined : Number(values[name]));
    return {
      file: positionals[0],
      expectCharts: number("expect-charts"),
      width: number("width"),
      screenshot: values.screenshot,
      dark: values.dark,
    };
  } catch (error) {
    console.error(`${usage}; ${error.message}.`);
    process.exit(2);
  }
}

const { file, ...options } = command();
if (!chromium()) {
  console.log("skipped: no Chromium found; install the package chromium or set MOTE_CHROMIUM");
  process.exit(77);
}
const { failures, charts } = await withBrowser((browser) => inspect(browser, file, options));
for (const { title, ink } of charts)
  console.log(`chart "${title}": ${ink.map(([name, n]) => `${name} ${n} px`).join(", ")}`);
for (const failure of failures) console.error(`FAILED ${failure}`);
console.log(
  failures.length ? `${file}: ${failures.length} failures` : `${file}: ${charts.length} charts drawn, nothing wrong`,
);
process.exit(failures.length ? 1 : 0);
