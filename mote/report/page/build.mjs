// node build.mjs <entry> <bundle>: one script with everything the page runs, headed by the licences of what is in it.
import { readFileSync, writeFileSync } from "node:fs";
import { buildSync } from "esbuild";

const [entry, bundle] = process.argv.slice(2);

const licences = [
  ["Apache ECharts", "echarts/NOTICE", "echarts/LICENSE"],
  ["ZRender", "zrender/LICENSE"],
  ["tslib", "tslib/LICENSE.txt"],
].map(([name, ...files]) => [name, ...files.map((file) => readFileSync(`node_modules/${file}`, "utf8"))].join("\n\n"));

const { outputFiles } = buildSync({
  entryPoints: [entry],
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2020"],
  define: { "process.env.NODE_ENV": '"production"' },
  legalComments: "none",
  write: false,
});
const script = `/*\n${licences.join("\n\n").replaceAll("*/", "* /")}\n*/\n${outputFiles[0].text}`;

// Either would end or hide the <script> element that the page puts this into.
const breakout = script.match(/<\/script|<!--/i);
if (breakout) throw new Error(`${bundle}: contains "${breakout[0]}", which cannot stand in a script element`);
writeFileSync(bundle, script);
