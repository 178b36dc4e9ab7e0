// Puts the report together in the browser.
import "./style.css";
import { makeCurves } from "./curves";
import { h, iconButton } from "./dom";
import { readPage, type Page, type Table } from "./page";
import { makePlayer, type Player } from "./player";
import { openSeries } from "./series";
import { makeFacts, makeFigures, makeFooter, makeHeader, makeHelp, makeInputs, makeNotes, makeTables } from "./story";

type Theme = "auto" | "light" | "dark";

function storage(): Storage | null {
  try {
    return window.sessionStorage;
  } catch {
    return null; // some browsers refuse it for pages from disk
  }
}

/** Place and colours survive the reload of a page whose run goes on, and the last one, after which it does not. */
function remember(page: Page, player: Player) {
  const key = `polder:${page.title}`;
  const text = storage()?.getItem(key);
  if (!page.reload) storage()?.removeItem(key);
  if (text) {
    const state = JSON.parse(text) as { time: number; atEnd: boolean; colours: string[]; scroll: number };
    if (state.atEnd) player.clock.seek(page.times.length - 1);
    else player.clock.seekTime(state.time);
    state.colours.forEach((c, k) => {
      const legend = player.legends[k];
      if (legend && (c === "" || legend.series.choices.some((choice) => choice.key === c))) void legend.choose(c);
    });
    window.scrollTo(0, state.scroll);
  }
  if (!page.reload) return;
  setInterval(() => {
    if (player.clock.playing) return;
    const state = {
      time: player.clock.time(),
      atEnd: player.clock.frame >= page.times.length - 1,
      colours: player.legends.map((l) => l.key()),
      scroll: window.scrollY,
    };
    storage()?.setItem(key, JSON.stringify(state));
    location.reload();
  }, 1000 * page.reload);
}

async function start() {
  const page = readPage();
  document.title = page.title;
  const root = document.getElementById("polder")!;
  const help = makeHelp();
  let theme: Theme = "auto";
  let restyle = () => {};
  const setTheme = (next: Theme) => {
    theme = next;
    if (theme === "auto") delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    restyle();
  };
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  dark.addEventListener("change", () => restyle());
  const flip = () => setTheme((theme === "auto" ? dark.matches : theme === "dark") ? "light" : "dark");
  const corner = h(
    "div",
    { class: "corner", role: "group", "aria-label": "Page" },
    iconButton("keys", "Keys (?)", () => help.showModal()),
    iconButton("theme", "Light or dark", flip),
    iconButton("print", "Print", () => window.print()),
  );
  const header = makeHeader(page);
  header.append(corner);
  root.append(header, ...[makeFacts(page), makeNotes(page)].filter((e): e is HTMLElement => e !== null));

  if (page.times.length > 0 && page.sets.some((s) => s.entries > 0)) {
    const series = await Promise.all(page.sets.map((s) => openSeries(s, page.times.length)));
    await document.fonts?.load('400 12px "Source Sans 3"').catch(() => undefined);
    const player = makePlayer(page, series);
    root.append(player.element);
    const curves = makeCurves(page, player);
    if (curves) root.append(curves.element);
    restyle = () => {
      player.redraw();
      curves?.rebuild();
    };
    document.addEventListener("keydown", (event) => {
      const target = event.target as HTMLElement;
      if (event.ctrlKey || event.metaKey || event.altKey || help.open) return;
      if (target.closest("select, input:not([type=range]):not([type=checkbox]), textarea, summary")) return;
      if (event.key === " " && target.closest("button, input[type=checkbox]")) return;
      if (event.key === "?") help.showModal();
      else if (!player.key(event)) return;
      event.preventDefault();
    });
    remember(page, player);
    window.addEventListener("beforeprint", restyle);
    // For tests and the curious.
    Object.assign(window, { polder: { page, player, series } });
  }
  const compared = (t: Table) => t.id === "comparison" || t.id === "validation";
  root.append(...makeTables(page, compared), ...makeFigures(page), ...makeTables(page, (t) => !compared(t)), ...[makeInputs(page)].filter((e): e is HTMLElement => e !== null), makeFooter(page), help);
  document.documentElement.dataset.ready = "yes";
}

start().catch((error: unknown) => {
  const text = error instanceof Error ? error.message : String(error);
  document.getElementById("polder")?.append(h("p", { class: "broken", role: "alert" }, `The report could not be shown: ${text}`));
  console.error(error);
});
