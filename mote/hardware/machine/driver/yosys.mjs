// node yosys.mjs PACKAGE OPTIONS: the Yosys of npm's @yowasp/yosys, which lies in the folder PACKAGE; it sees the files of the folder
// that it is started in, and no others.
import { readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, ...options] = process.argv.slice(2);
const { runYosys, Exit } = await import(pathToFileURL(join(folder, "gen", "bundle.js")));
const files = {};
for (const name of readdirSync(".")) if (statSync(name).isFile()) files[name] = readFileSync(name);
try {
  await runYosys(options, files, {
    stdout: (bytes) => bytes && process.stdout.write(bytes),
    stderr: (bytes) => bytes && process.stderr.write(bytes),
  });
} catch (error) {
  if (!(error instanceof Exit)) throw error;
  process.exitCode = error.code;
}
