// What a look at the layout of a page finds wrong; runs in the page.

/** Elements that reach beyond the page, and pairs of texts or controls that overlap. */
export const faults = () => {
  const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  const found = wide > 0 ? [`the page is ${wide} px too wide`] : [];
  const things = [...document.querySelectorAll("h1, h2, p, dt, dd, button, select, input, label, .chart-title, .keys, .clock, .unit, th, td")].filter((e) => {
    const style = getComputedStyle(e);
    return e.offsetWidth > 1 && style.visibility !== "hidden" && !e.closest("dialog, .tip, .scroll, details:not([open]) > :not(summary)") && !e.classList.contains("hidden");
  });
  const boxes = things.map((e) => e.getBoundingClientRect());
  const name = (e) => `${e.tagName.toLowerCase()}.${e.className} "${(e.textContent || e.getAttribute("aria-label") || "").slice(0, 30)}"`;
  things.forEach((a, i) => {
    if (boxes[i].right > innerWidth + 0.5 || boxes[i].left < -0.5) found.push(`${name(a)} leaves the page`);
    things.forEach((b, k) => {
      if (k <= i || a.contains(b) || b.contains(a)) return;
      const across = Math.min(boxes[i].right, boxes[k].right) - Math.max(boxes[i].left, boxes[k].left);
      const down = Math.min(boxes[i].bottom, boxes[k].bottom) - Math.max(boxes[i].top, boxes[k].top);
      if (across > 1 && down > 1) found.push(`${name(a)} lies over ${name(b)}`);
    });
  });
  for (const e of document.querySelectorAll("button, select, dd, dt, .chart-title")) if (e.scrollWidth > e.clientWidth + 1 && getComputedStyle(e).overflow !== "visible") found.push(`${name(e)} is cut off`);
  return found;
};
