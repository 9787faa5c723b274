// The page's script: draws every chart of the data block, links their zooms, adds the copy button.
import { prepare } from "./prepare.js";
import { Plot } from "./plot.js";
import { button } from "./parts.js";
import { onThemeChange } from "./theme.js";

/** A chart that fails says so in its place, and the others are still drawn. */
function guarded(figure, draw) {
  try {
    return [draw()];
  } catch (error) {
    const message = Object.assign(document.createElement("p"), {
      className: "error",
      textContent: `This chart could not be drawn: ${error.message}`,
    });
    message.setAttribute("role", "alert");
    figure.append(message);
    reportError(error);
    return [];
  }
}

const charts = JSON.parse(document.getElementById("charts-data").textContent);
const figures = [...document.querySelectorAll("figure[data-chart]")];

const follows = (a, b) =>
  a !== b && !b.chart.plane && a.chart.x_label === b.chart.x_label && a.chart.log_x === b.chart.log_x;
const zoomed = (plot) =>
  plots.filter((other) => follows(plot, other)).forEach((other) => other.join(plot.window?.x ?? null));
const plots = figures.flatMap((figure, i) => guarded(figure, () => new Plot(figure, prepare(charts[i]), zoomed)));
onThemeChange(() => plots.forEach((plot) => plot.repaint()));

if (plots.length) {
  const hint =
    "Ctrl + wheel or pinch zooms, dragging moves, a double click resets; a name in a legend hides and shows its series.";
  figures[0].before(Object.assign(document.createElement("p"), { className: "hint", textContent: hint }));
}

function select(node) {
  getSelection().selectAllChildren(node);
}

for (const pre of document.querySelectorAll("pre")) {
  const copy = button("Copy", "Copy the command", async () => {
    const copied = await navigator.clipboard.writeText(pre.textContent).then(
      () => true,
      () => false,
    );
    if (!copied) select(pre.firstElementChild); // without permission the reader presses Ctrl + C
    copy.textContent = copied ? "Copied" : "Selected";
    setTimeout(() => (copy.textContent = "Copy"), 2000);
  });
  copy.className = "copy";
  const holder = Object.assign(document.createElement("div"), { className: "command" });
  pre.replaceWith(holder);
  holder.append(pre, copy);
}
