#pragma once
// The look of the pages: one column, system letters, figures at the width of the text, tables that scroll on a phone
// and break well on paper.
#include <string_view>

namespace polder {

inline constexpr std::string_view report_style = R"css(
:root { color-scheme: light; --ink: #22262b; --soft: #6a7178; --line: #e3e6e9; --water: #1c6aa8; }
* { box-sizing: border-box; }
body { margin: 0; background: #f6f7f8; color: var(--ink); font: 16px/1.5 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 1060px; margin: 0 auto; padding: 32px 24px 64px; background: #fff; min-height: 100vh; }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 6px; }
h2 { font-size: 1.2rem; margin: 44px 0 12px; padding-top: 12px; border-top: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 22px 0 8px; }
p { margin: 8px 0; max-width: 46em; }
.soft, figcaption { color: var(--soft); }
.status { display: inline-block; padding: 1px 10px; border-radius: 10px; font-size: .85rem; font-weight: 600; color: #fff;
  background: var(--soft); vertical-align: 2px; margin-right: 8px; }
.status.finished { background: #1d7a4c; } .status.failed { background: #b3261e; }
.status.interrupted { background: #9a6200; } .status.running { background: var(--water); }
.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 1px; margin: 20px 0 0;
  background: var(--line); border: 1px solid var(--line); }
.facts div { background: #fff; padding: 10px 14px; }
.facts dt { font-size: .8rem; color: var(--soft); } .facts dd { margin: 0; font-size: 1.1rem; font-weight: 600; }
figure { margin: 10px 0; } img, svg { max-width: 100%; height: auto; display: block; }
.curves { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 480px), 1fr)); gap: 12px; }
.curves svg { width: 100%; }
table { border-collapse: collapse; font-size: .92rem; } .scroll { overflow-x: auto; }
th, td { text-align: left; vertical-align: top; padding: 5px 18px 5px 0; border-bottom: 1px solid var(--line); }
thead th { font-weight: 600; color: var(--soft); } .number { text-align: right; font-variant-numeric: tabular-nums; }
table.outline th { font-weight: 400; color: var(--soft); white-space: nowrap; } table.outline table { margin: 2px 0 6px; }
table.outline tr:last-child > * { border-bottom: 0; }
summary { cursor: pointer; } code { font-family: "DejaVu Sans Mono", monospace; font-size: .88em; }
.instants > input { position: absolute; opacity: 0; }
.instants > label { display: inline-block; padding: 2px 11px; margin: 0 4px 6px 0; border: 1px solid var(--line);
  border-radius: 12px; font-size: .85rem; cursor: pointer; font-variant-numeric: tabular-nums; }
.instants > input:checked + label { background: var(--ink); border-color: var(--ink); color: #fff; }
.instants > input:focus-visible + label { outline: 2px solid var(--water); outline-offset: 1px; }
.instants > figure { display: none; }
a { color: var(--water); } footer { margin-top: 48px; padding-top: 12px; border-top: 1px solid var(--line); font-size: .85rem; }
@media print { body { background: #fff; } main { max-width: none; padding: 0; } h2 { break-after: avoid; }
  figure, tr { break-inside: avoid; } .instants > label { display: none; } .instants > figure { display: block !important; } }
)css";

}  // namespace polder
