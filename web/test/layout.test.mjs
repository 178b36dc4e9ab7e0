// Nothing overflows, nothing lies over anything else, and the rules of accessibility that a machine can check hold:
// at the width of a desk and of a phone, light and dark.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { describe, test } from "node:test";
import { open, settle } from "./browser.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const pictures = process.env.POLDER_SCREENSHOTS;

/** Elements that reach beyond the page, and pairs of texts or controls that overlap. */
const faults = () => {
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

for (const [width, height] of [[1280, 900], [390, 844]])
  for (const scheme of ["light", "dark"])
    describe(`${width} px, ${scheme}`, () => {
      test("nothing overflows or overlaps, and axe finds nothing", async (t) => {
        const { page, seen, close } = await open({ width, height, scheme });
        t.after(close);
        await page.evaluate(async () => {
          window.polder.player.clock.seek(Math.round(0.6 * window.polder.page.times.length));
          await window.polder.player.legends[1].choose("pressure");
        });
        await settle(page);
        assert.deepEqual(await page.evaluate(faults), []);
        await page.evaluate(axe);
        const { violations } = await page.evaluate(() => axe.run());
        assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(", ")}`), []);
        assert.deepEqual(seen.errors, []);
        if (pictures) {
          mkdirSync(pictures, { recursive: true });
          await page.screenshot({ path: `${pictures}/report-${width}-${scheme}.png`, fullPage: true });
        }
      });
    });

test("a tap reads a point", async (t) => {
  const { page, seen, close } = await open({ width: 390, height: 844, touch: true });
  t.after(close);
  const at = await page.evaluate(() => {
    const soil = window.polder.series.find((s) => s.name === "soil");
    return window.polder.player.screenOf(soil.x[100], soil.y[100]);
  });
  const box = await page.locator(".points").boundingBox();
  await page.touchscreen.tap(box.x + at.x, box.y + at.y);
  await page.locator(".tip").waitFor({ state: "visible" });
  assert.match(await page.locator(".tip").textContent(), /Soil point/);
  assert.deepEqual(seen.errors, []);
});

test("the printed page keeps the picture and drops the controls", async (t) => {
  const { page, close } = await open();
  t.after(close);
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.locator(".transport").isVisible(), false);
  assert.equal(await page.locator(".points").isVisible(), true);
  const pdf = await page.pdf({ format: "A4" });
  assert.equal(pdf.subarray(0, 4).toString(), "%PDF");
});
