// The colours live in style.css; the canvas reads them from there, so that light, dark and print agree with the page.

const read = (styles, name) => styles.getPropertyValue(`--${name}`).trim();

/** The colours now in force: ink, soft (labels), line (axes), grid, ground, and the list of series colours. */
export function theme() {
  const styles = getComputedStyle(document.documentElement);
  const colours = [1, 2, 3, 4, 5, 6].map((i) => read(styles, `series-${i}`));
  const [ink, soft, line, grid, ground] = ["ink", "soft", "line", "grid", "ground"].map((name) => read(styles, name));
  return { ink, soft, line, grid, ground, colours, font: styles.fontFamily };
}

/** Calls `repaint` when the colours change: the system's scheme, and paper, which is always light. */
export function onThemeChange(repaint) {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  const paper = (printing) => () => {
    document.documentElement.classList.toggle("paper", printing);
    repaint();
  };
  addEventListener("beforeprint", paper(true));
  addEventListener("afterprint", paper(false));
  matchMedia("print").addEventListener("change", repaint); // the scheme may return after "afterprint"
}
