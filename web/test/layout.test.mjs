// Nothing overflows, nothing lies over anything else, and the rules of accessibility that a machine can check hold:
// at the width of a desk and of a phone, light and dark.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { describe, test } from "node:test";
import { axeFaults, open, settle } from "./browser.mjs";
import { faults } from "./faults.mjs";

const pictures = process.env.POLDER_SCREENSHOTS;

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
        assert.deepEqual(await axeFaults(page), []);
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
  assert.equal(await page.locator(".legend.soil .printed").isVisible(), true);
  assert.match(await page.locator(".legend.soil .printed").textContent(), /strain/);
  const pdf = await page.pdf({ format: "A4" });
  assert.equal(pdf.subarray(0, 4).toString(), "%PDF");
});
