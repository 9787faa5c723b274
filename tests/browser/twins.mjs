// node tests/browser/twins.mjs SAMPLE.html
//
// Twins of the sample page that must fail: each breaks one promise, and the check must say which. Exit 0: all were caught.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium, inspect, withBrowser } from "./inspect.mjs";

const charts = 7;
const atEnd = (html) => (page) => page.replace("</body>", `${html}</body>`);
const withoutPolicy = (page) => page.replace(/<meta http-equiv="Content-Security-Policy"[^>]*>/, "");

const twins = [
  {
    name: "a script error",
    spoil: atEnd("<script>throw new Error('deliberate')</script>"),
    says: ["page error: deliberate", "the page says: A script of this page failed"],
  },
  {
    name: "a rejected promise",
    spoil: atEnd("<script>Promise.reject(new Error('late'))</script>"),
    says: ["page error: late", "the page says:"],
  },
  {
    name: "a console error",
    spoil: atEnd("<script>console.error('murmur')</script>"),
    says: ["console error: murmur"],
  },
  {
    name: "damaged data",
    spoil: (page) => page.replace('id="charts-data">[', 'id="charts-data">[['),
    says: ["page error", "not rendered"],
  },
  {
    name: "one damaged chart",
    spoil: (page) => page.replace('"mark":"steps"', '"mark":"stairs"'),
    says: ["page error", "the page says: This chart could not be drawn"],
  },
  {
    name: "an image from a server, refused by the page's policy",
    spoil: atEnd('<img alt="" src="http://127.0.0.1:9/x.png">'),
    says: ["console error"],
  },
  {
    name: "an image from a server, without the policy",
    spoil: (page) => withoutPolicy(atEnd('<img alt="" src="http://127.0.0.1:9/x.png">')(page)),
    says: ["request to outside the page: http://127.0.0.1:9/x.png"],
  },
  {
    name: "a chart too few",
    spoil: (page) => page.replace(/<figure data-chart="Nothing.*?<\/figure>/, ""),
    says: ["expected 7 charts, found 6"],
  },
  {
    name: "a wiped canvas",
    spoil: atEnd(
      "<script>setTimeout(() => document.querySelectorAll('[data-chart=Track] canvas').forEach((c) => (c.width = c.width)))</script>",
    ),
    says: ['chart "Track": blank'],
  },
];

if (!chromium()) {
  console.log("skipped: no Chromium found; install the package chromium or set MOTE_CHROMIUM");
  process.exit(77);
}
const sample = readFileSync(process.argv[2], "utf8");
const folder = mkdtempSync(join(tmpdir(), "mote-twins-"));
let missed = 0;
try {
  await withBrowser(async (browser) => {
    for (const { name, spoil, says } of twins) {
      const file = join(folder, "twin.html");
      const spoilt = spoil(sample);
      writeFileSync(file, spoilt);
      const { failures } = await inspect(browser, file, { expectCharts: charts });
      const caught = spoilt !== sample && says.every((text) => failures.some((failure) => failure.includes(text)));
      console.log(`${caught ? "caught" : "MISSED"}  ${name}`);
      if (!caught) console.log(`        expected ${says.join(" and ")}, got ${failures.join("; ") || "no failure"}`);
      missed += caught ? 0 : 1;
    }
  });
} finally {
  rmSync(folder, { recursive: true });
}
process.exit(missed ? 1 : 0);
