// A headless Chromium for the tests: a fresh profile each time, nothing in the background.
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const report = process.env.POLDER_REPORT;
if (!report || !existsSync(report)) throw new Error("POLDER_REPORT must name a report.html (see web/README.md)");

const always = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

/** Opens the report for one test `t` (or a suite, whose `after` must call close); `seen` collects what it says on the console, its errors and every request. */
export async function open({ width = 1280, height = 900, args = [], scheme = "light", file = report, touch = false } = {}) {
  const profile = mkdtempSync(join(tmpdir(), "polder-viewer-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [...always, ...args],
    viewport: { width, height },
    colorScheme: scheme,
    hasTouch: touch,
    acceptDownloads: true,
  });
  const page = await context.newPage();
  const seen = { errors: [], requests: [] };
  page.on("pageerror", (error) => seen.errors.push(String(error)));
  page.on("console", (message) => message.type() === "error" && seen.errors.push(message.text()));
  page.on("request", (request) => seen.requests.push(request.url()));
  const begin = Date.now();
  await page.goto(pathToFileURL(file).href);
  // Pages of tables only (studies, verification) have no script and are ready at once.
  await page.waitForSelector("html[data-ready=yes], body:not(:has(script))", { state: "attached", timeout: 60000 });
  const ready = Date.now() - begin;
  const close = async () => {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  };
  return { page, seen, ready, close };
}

/** Waits until the picture has been drawn twice more. */
export const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));

/** Colours of the points' canvas on a coarse lattice, as one text, and how many differ from nothing. */
export const lattice = (page) =>
  page.evaluate(async () => {
    const source = document.querySelector(".points");
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [160, 60];
    const pen = copy.getContext("2d");
    pen.drawImage(source, 0, 0, copy.width, copy.height);
    const pixels = pen.getImageData(0, 0, copy.width, copy.height).data;
    const colours = new Set();
    let drawn = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i + 3] === 0) continue;
      ++drawn;
      colours.add(`${pixels[i] >> 4} ${pixels[i + 1] >> 4} ${pixels[i + 2] >> 4}`);
    }
    return { drawn: drawn / (pixels.length / 4), colours: colours.size, picture: Array.from(pixels).join() };
  });

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** What axe finds against the rules of accessibility. It runs beside the page's own policy, which forbids scripts from elsewhere. */
export async function axeFaults(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => axe.run());
  return violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(", ")}`);
}
