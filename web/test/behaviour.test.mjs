// What readers do besides playing: keyboard alone, switching lines and theme, a page whose run goes on, the comparison.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { open, report, settle } from "./browser.mjs";

test("every control is reached by Tab, has a name and shows that it has the focus", async (t) => {
  const { page, seen, close } = await open();
  t.after(close);
  const here = () =>
    page.evaluate(() => {
      const e = document.activeElement;
      if (!e || e === document.body) return null;
      const style = getComputedStyle(e);
      const name = e.getAttribute("aria-label") || e.title || e.labels?.[0]?.textContent || e.textContent;
      return { what: `${e.tagName.toLowerCase()}.${e.className}`, name: name.trim(), marked: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 1 };
    });
  const passed = [];
  for (let k = 0; k < 100; ++k) {
    await page.keyboard.press("Tab");
    const at = await here();
    if (!at) break;
    passed.push(at);
  }
  const unnamed = passed.filter((p) => !p.name).map((p) => p.what);
  assert.deepEqual(unnamed, [], "without a name");
  assert.deepEqual(passed.filter((p) => !p.marked).map((p) => p.what), [], "without a mark of focus");
  const visible = await page.locator("button:visible, select:visible, input:visible, summary:visible").count();
  const controls = passed.filter((p) => /^(button|select|input|summary)/.test(p.what)).length;
  assert.equal(controls, visible, "controls that Tab does not reach");
  assert.deepEqual(seen.errors, []);
});

test("the space bar plays from anywhere but a control that needs it", async (t) => {
  const { page, close } = await open();
  t.after(close);
  await page.keyboard.press(" ");
  assert.equal(await page.evaluate(() => window.polder.player.clock.playing), true);
  await page.keyboard.press(" ");
  assert.equal(await page.evaluate(() => window.polder.player.clock.playing), false);
  await page.locator("#colour-soil").focus();
  await page.keyboard.press("Home");
  assert.equal(await page.locator("#colour-soil").inputValue(), "", "keys in a list belong to the list");
});

test("water lines, outline and monitors can be switched off", async (t) => {
  const { page, close } = await open();
  t.after(close);
  const overlay = () => page.evaluate(() => document.querySelector(".overlay").toDataURL());
  let before = await overlay();
  for (const key of ["l", "o", "m"]) {
    await page.keyboard.press(key);
    await settle(page);
    const after = await overlay();
    assert.notEqual(after, before, `${key} changed nothing`);
    before = after;
  }
});

test("light and dark are a button away, and the picture follows", async (t) => {
  const { page, close } = await open({ scheme: "light" });
  t.after(close);
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).map(Number));
  const overlay = () => page.evaluate(() => document.querySelector(".overlay").toDataURL());
  const [light, drawn] = [await ground(), await overlay()];
  await page.getByRole("button", { name: "Light or dark" }).click();
  await settle(page);
  const dark = await ground();
  assert.ok(Math.min(...light) > 200 && Math.max(...dark) < 80, `${light} and ${dark}`);
  assert.notEqual(await overlay(), drawn);
});

test("a page whose run goes on loads itself again, until the end, and keeps its time and colour", async (t) => {
  const folder = mkdtempSync(join(tmpdir(), "polder-running-"));
  t.after(() => rmSync(folder, { recursive: true, force: true }));
  const file = join(folder, "report.html");
  const finished = readFileSync(report, "utf8");
  writeFileSync(file, finished.replace('"status":"finished"', '"status":"running"').replace('"reload":0.0', '"reload":6.0'));
  const { page, seen, close } = await open({ file });
  t.after(close);
  const loadedAgain = async () => {
    await page.waitForEvent("load", { timeout: 60000 });
    await page.waitForFunction(() => document.documentElement.dataset.ready === "yes" && window.polder.player.legends[0].key() === "porosity", null, { timeout: 30000 });
  };
  assert.equal(await page.locator(".status").textContent(), "running");
  await page.evaluate(() => {
    window.polder.player.clock.seek(7);
    void window.polder.player.legends[0].choose("porosity");
  });
  await loadedAgain();
  assert.equal(await page.evaluate(() => window.polder.player.clock.frame), 7);
  assert.equal(await page.locator(".status").textContent(), "running");

  writeFileSync(file, finished);
  await loadedAgain();
  assert.equal(await page.evaluate(() => window.polder.player.clock.frame), 7);
  assert.equal(await page.locator(".status").textContent(), "finished");
  assert.deepEqual(seen.errors, []);
});

test("the comparison says what was computed, asked and found", async (t) => {
  const { page, close } = await open();
  t.after(close);
  const rows = await page.locator("#comparison tbody tr").evaluateAll((list) => list.map((r) => [...r.children].map((c) => c.textContent)));
  const verdicts = Object.fromEntries(rows.map((r) => [r[0], r[5]]));
  assert.deepEqual(verdicts, { "settlement of the crest": "within", "porosity of the toe": "outside", "difference between grids": "takes other runs too", "run-out": "not judged" });
  assert.match(rows[0][2], /^0\.0998\sm$/u);
  assert.equal(await page.locator("#comparison td.pass").count(), 1);
  assert.equal(await page.locator("#comparison td.fail").count(), 1);
});
