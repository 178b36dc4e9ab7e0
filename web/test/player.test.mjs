import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { lattice, open, settle } from "./browser.mjs";

describe("the player", () => {
  let browser, page;
  before(async () => {
    browser = await open();
    page = browser.page;
  });
  after(() => browser.close());

  const place = () => page.evaluate(() => window.polder.player.clock.place);
  const press = async (key) => {
    await page.keyboard.press(key);
    await settle(page);
  };

  test("loads without errors, and nothing but the file itself is asked for", () => {
    assert.deepEqual(browser.seen.errors, []);
    assert.equal(browser.seen.requests.length, 1);
    assert.match(browser.seen.requests[0], /^file:/);
  });

  test("draws with WebGL, and the canvas is not blank", async () => {
    await press("End");
    assert.equal(await page.evaluate(() => window.polder.player.painter()), "webgl");
    const seen = await lattice(page);
    assert.ok(seen.drawn > 0.2, `only ${seen.drawn} of the canvas is drawn`);
    assert.ok(seen.colours > 10, `only ${seen.colours} colours`);
  });

  test("decodes what was written: points lie where the formulas put them", async () => {
    // Soil point 1 starts at (2.015, 0.015); the section is 6 m wide and one step 6/16000 m.
    const worst = await page.evaluate(() => {
      const soil = window.polder.series.find((s) => s.name === "soil");
      const e = soil.ids.indexOf("1");
      const progress = (t) => 1 / (1 + Math.exp(-(t - 6)));
      let most = 0;
      window.polder.page.times.forEach((t, f) => {
        const entry = soil.start[f] + e;
        const [x0, y0] = [2.015, 0.015];
        const share = ((x0 - 2) / 2.2) * y0;
        most = Math.max(most, Math.abs(soil.x[entry] - (x0 + 0.9 * share * progress(t))), Math.abs(soil.y[entry] - (y0 - 0.35 * share * y0 * progress(t))));
      });
      return most;
    });
    assert.ok(worst <= 6 / 16000, `${worst} m off`);
  });

  test("playing changes the picture and the time", async () => {
    await page.keyboard.press("Home");
    await settle(page);
    const still = await lattice(page);
    await page.locator("button.play").click();
    await page.waitForFunction(() => window.polder.player.clock.place > 20, null, { timeout: 30000 });
    await page.locator("button.play").click();
    await settle(page);
    const p = await place();
    assert.equal(p, Math.round(p), "it comes to rest on a snapshot");
    assert.notEqual((await lattice(page)).picture, still.picture);
    assert.notEqual(await page.locator(".clock").textContent(), "0.0\u202fs");
  });

  test("keys step, jump, zoom and switch", async () => {
    await press("Home");
    assert.equal(await place(), 0);
    await press("ArrowRight");
    assert.equal(await place(), 1);
    await press("End");
    assert.equal(await place(), (await page.evaluate(() => window.polder.page.times.length)) - 1);
    const home = (await lattice(page)).picture;
    await press("0");
    const whole = (await lattice(page)).picture;
    await press("s");
    assert.notEqual((await lattice(page)).picture, whole, "S hides the soil");
    await press("s");
    await press("+");
    assert.notEqual((await lattice(page)).picture, whole, "+ zooms");
    await press("0");
    assert.equal((await lattice(page)).picture, whole, "0 shows all again");
    await page.locator(".points").dblclick();
    await settle(page);
    assert.equal((await lattice(page)).picture, home, "a double click shows what the run fills");
    await press("?");
    assert.ok(await page.locator("dialog.help").isVisible());
    await press("Escape");
  });

  test("every field can be coloured by, with a unit and a range", async () => {
    for (const set of ["soil", "water"]) {
      const keys = await page.locator(`#colour-${set} option`).evaluateAll((list) => list.map((o) => o.value));
      assert.ok(keys.length >= (set === "soil" ? 11 : 3), `${set}: ${keys}`);
      for (const key of keys) {
        await page.locator(`#colour-${set}`).selectOption(key);
        await page.waitForFunction(([s, k]) => (window.polder.player.legends.find((l) => l.series.name === s).colouring().field?.key ?? "") === k, [set, key]);
        await settle(page);
        const { low, high } = await page.evaluate((s) => {
          const { low, high } = window.polder.player.legends.find((l) => l.series.name === s).colouring();
          return { low, high };
        }, set);
        assert.ok(high > low, `${key}: ${low}…${high}`);
      }
      await page.locator(`#colour-${set}`).selectOption(set === "soil" ? "pore_pressure" : "");
    }
    await settle(page);
    assert.equal(await page.locator(".legend.soil .unit").textContent(), "kPa");
  });

  test("a range that is typed holds", async () => {
    const high = page.locator(".legend.soil .range-end.high");
    await high.fill("5");
    await high.press("Enter");
    await high.blur();
    await settle(page);
    assert.equal(await page.evaluate(() => window.polder.player.legends[0].colouring().high), 5000);
    assert.equal(await page.locator(".legend.soil select.quiet").inputValue(), "fixed");
  });

  test("the smooth field differs from the points", async () => {
    const points = (await lattice(page)).picture;
    await page.getByLabel("smooth field").check();
    await settle(page);
    const smooth = await lattice(page);
    assert.notEqual(smooth.picture, points);
    assert.ok(smooth.drawn > 0.2);
    await page.getByLabel("smooth field").uncheck();
  });

  test("hovering reads the values of the point under the pointer", async () => {
    const at = await page.evaluate(() => {
      const soil = window.polder.series.find((s) => s.name === "soil");
      const e = soil.start[window.polder.player.clock.frame] + 200;
      return { ...window.polder.player.screenOf(soil.x[e], soil.y[e]), id: soil.ids[soil.track[e]] };
    });
    const box = await page.locator(".points").boundingBox();
    await page.mouse.move(box.x + at.x, box.y + at.y);
    const tip = page.locator(".tip");
    await tip.waitFor({ state: "visible" });
    const text = await tip.textContent();
    assert.ok(text.includes(`Soil point ${at.id}`), text);
    assert.match(text, /Porosity.*0\.4/);
    assert.match(text, /kPa/);
  });

  test("arrows are drawn over the points", async () => {
    const overlay = () => page.evaluate(() => document.querySelector(".overlay").toDataURL().length);
    await page.evaluate(() => window.polder.player.clock.seek(30));
    await settle(page);
    const before = await overlay();
    await page.getByLabel("soil velocity").check();
    await page.waitForFunction(() => window.polder.series[0].ready("speed"));
    await settle(page);
    assert.notEqual(await overlay(), before);
    await page.getByLabel("soil velocity").uncheck();
  });

  test("curves are drawn, follow the player and take it to a time", async () => {
    const inked = await page.locator(".chart canvas").evaluateAll((list) =>
      list.map((c) => c.getContext("2d").getImageData(0, 0, c.width, c.height).data.some((v, i) => i % 4 === 3 && v > 0)),
    );
    assert.ok(inked.length >= 5 && inked.every(Boolean), `${inked}`);
    const over = page.locator(".chart .u-over").first();
    await over.scrollIntoViewIfNeeded();
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 0.25 * box.width, box.y + 40);
    await page.mouse.click(box.x + 0.25 * box.width, box.y + 40);
    const time = await page.evaluate(() => window.polder.player.clock.time());
    const end = await page.evaluate(() => window.polder.page.times.at(-1));
    assert.ok(Math.abs(time - 0.25 * end) < 0.05 * end, `${time} of ${end}`);
    assert.match(await page.locator(".chart .key b").first().textContent(), /\d/);
  });

  test("saves a picture and an animation", async () => {
    const [png] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save picture (PNG)" }).click()]);
    const bytes = readFileSync(await png.path());
    assert.equal(bytes.subarray(1, 4).toString(), "PNG");
    assert.ok(bytes.readUInt32BE(16) > 1500, "wide enough to print");
    await page.evaluate(() => (window.polder.player.clock.duration = 1.5));
    const [film] = await Promise.all([page.waitForEvent("download", { timeout: 60000 }), page.getByRole("button", { name: "Save animation" }).click()]);
    const moving = readFileSync(await film.path());
    assert.equal(moving.readUInt32BE(0), 0x1a45dfa3, "WebM begins with the sign of EBML");
    const played = await page.evaluate(async (base64) => {
      const video = document.createElement("video");
      video.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: "video/webm" }));
      await new Promise((done, fail) => ((video.onloadeddata = done), (video.onerror = () => fail(new Error(video.error.message)))));
      return { width: video.videoWidth, height: video.videoHeight };
    }, moving.toString("base64"));
    assert.ok(played.width > 1000 && played.height > 200, `${played.width} × ${played.height}`);
  });

  test("the tables of the story are there, and text of the case stays text", async () => {
    for (const id of ["materials", "boundaries", "stages", "audit", "cost", "inputs"]) assert.equal(await page.locator(`#${id}`).count(), 1, id);
    assert.ok((await page.locator("#materials thead").textContent()).includes("Loose <sand>"));
    assert.deepEqual(browser.seen.errors, []);
  });
});

describe("without WebGL", () => {
  test("the 2D canvas shows the same run", async (t) => {
    const { page, seen, close } = await open({ args: ["--disable-3d-apis"] });
    t.after(close);
    assert.equal(await page.evaluate(() => window.polder.player.painter()), "canvas");
    const first = await lattice(page);
    assert.ok(first.drawn > 0.2, `only ${first.drawn} of the canvas is drawn`);
    await page.keyboard.press("End");
    await settle(page);
    const last = await lattice(page);
    assert.notEqual(last.picture, first.picture);
    assert.ok(last.colours > 10, `only ${last.colours} colours`);
    await page.getByLabel("smooth field").check();
    await settle(page);
    const smooth = await lattice(page);
    assert.notEqual(smooth.picture, last.picture);
    assert.ok(Math.abs(smooth.drawn - last.drawn) < 0.1 * last.drawn, `${smooth.drawn} is drawn, ${last.drawn} as points`);
    assert.deepEqual(seen.errors, []);
  });
});

describe("without DecompressionStream", () => {
  test("the bundled inflater reads the same data", async (t) => {
    const read = async (page) => page.evaluate(async () => Array.from((await window.polder.series[0].field("porosity")).values.slice(0, 500)));
    const modern = await open();
    t.after(modern.close);
    const values = await read(modern.page);
    await modern.page.addInitScript(() => delete window.DecompressionStream);
    await modern.page.reload();
    await modern.page.waitForSelector("html[data-ready=yes]", { state: "attached" });
    assert.equal(await modern.page.evaluate(() => typeof DecompressionStream), "undefined");
    assert.deepEqual(await read(modern.page), values);
  });
});
