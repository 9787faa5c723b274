// Small pieces of a figure: buttons, the legend, the sign of a series.
import { colourOf } from "./option.js";

export function button(text, label, press) {
  const node = Object.assign(document.createElement("button"), { type: "button", textContent: text });
  node.setAttribute("aria-label", label);
  node.addEventListener("click", press);
  return node;
}

const signs = {
  band: '<rect x="1" y="2" width="22" height="10" rx="2" fill="currentColor" opacity="0.3"/>',
  bars: '<rect x="1" y="1" width="13" height="5" fill="currentColor"/><rect x="10" y="8" width="13" height="5" fill="currentColor"/>',
  points: '<circle cx="6" cy="7" r="3" fill="currentColor"/><circle cx="17" cy="7" r="3" fill="currentColor"/>',
  diamonds: '<path d="M6 3L10 7L6 11L2 7ZM17 3L21 7L17 11L13 7Z" fill="currentColor"/>',
  steps: '<path d="M1 11H9V3H17V8H23" fill="none" stroke="currentColor" stroke-width="2"/>',
  line: '<path d="M1 7H23" stroke="currentColor" stroke-width="2.5"/>',
  marked:
    '<path d="M1 7H23" stroke="currentColor" stroke-width="2.5"/><circle cx="12" cy="7" r="3.5" fill="currentColor"/>',
  truth: '<path d="M1 7H23" stroke="currentColor" stroke-width="2" stroke-dasharray="6 3"/>',
};

const palette = 6; // colours of the style sheet

const signOf = (item) =>
  item.truth ? signs.truth : signs[item.mark === "points" && item.colour >= palette ? "diamonds" : item.mark];

/** The sign of an item; without colours it takes those of the style sheet and follows the scheme by itself. */
export function swatch(item, colours) {
  const node = document.createElement("span");
  node.className = "swatch";
  node.innerHTML = `<svg viewBox="0 0 24 14" width="24" height="14" aria-hidden="true">${signOf(item)}</svg>`;
  node.style.color = colours
    ? colourOf(item, colours)
    : item.truth
      ? "var(--ink)"
      : `var(--series-${(item.colour % palette) + 1})`;
  return node;
}

/** One button per item, pressed while the item is shown; toggle(item, shown) is called on a press. */
export function legend(items, toggle) {
  const list = document.createElement("div");
  list.className = "legend";
  for (const item of items) {
    const entry = button("", item.name || "unnamed series", () => {
      const shown = entry.getAttribute("aria-pressed") !== "true";
      entry.setAttribute("aria-pressed", shown);
      toggle(item, shown);
    });
    entry.setAttribute("aria-pressed", "true");
    entry.dataset.mark = item.mark;
    entry.append(swatch(item), Object.assign(document.createElement("span"), { textContent: item.name || "unnamed" }));
    list.append(entry);
  }
  return list;
}
