// The pages beside the report (studies, verification, factors of safety) and reports of other runs, at both widths: nothing
// overflows or overlaps, axe finds nothing, nothing is asked for. POLDER_PAGES names them, with colons between.
import assert from "node:assert/strict";
import { basename, dirname } from "node:path";
import { describe, test } from "node:test";
import { axeFaults, open, settle } from "./browser.mjs";
import { faults } from "./faults.mjs";

const pages = (process.env.POLDER_PAGES ?? "").split(":").filter(Boolean);

for (const file of pages)
  describe(`${basename(dirname(file))}/${basename(file)}`, () => {
    for (const [width, height, scheme] of [
      [1280, 900, "light"],
      [390, 844, "light"],
      [390, 844, "dark"],
    ])
      test(`${width} px, ${scheme}: everything has its place`, async (t) => {
        const { page, seen, close } = await open({ file, width, height, scheme });
        t.after(close);
        await settle(page);
        assert.ok((await page.locator("h1").textContent()).length > 3);
        assert.deepEqual(await page.evaluate(faults), []);
        assert.deepEqual(await axeFaults(page), []);
        assert.deepEqual(seen.errors, []);
        assert.equal(seen.requests.filter((r) => !r.startsWith("data:")).length, 1);
      });
  });

const levee = pages.find((p) => /levee/.test(p));
test("a river that has a level and no points is drawn, and sinks with its level", { skip: !levee && "no page of such a run" }, async (t) => {
  const { page, close } = await open({ file: levee });
  t.after(close);
  const blue = (frame) =>
    page.evaluate(async (f) => {
      const { page: content, player } = window.polder;
      player.clock.seek(f);
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      const canvas = document.querySelector(".overlay");
      const pen = canvas.getContext("2d");
      const [time, level] = [content.times[f], content.levels[0].head[0][1]];
      // A column of the canvas over the ground at x = 1 m, from y = 3.1 m up.
      const at = (y) => player.screenOf(1, y);
      let filled = 0;
      for (let y = 3.1; y < 9; y += 0.05) filled += pen.getImageData(Math.round(at(y).x), Math.round(at(y).y), 1, 1).data[3] > 100 ? 0.05 : 0;
      return { time, level, filled };
    }, frame);
  const last = await page.evaluate(() => window.polder.page.times.length - 1);
  const [first, end] = [await blue(0), await blue(last)];
  assert.ok(first.filled < 0.2, `dry at first: ${first.filled} m`);
  assert.ok(end.filled > 0.5, `${end.filled} m of water after ${end.time} s`);
});
