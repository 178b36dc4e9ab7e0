// What the page carries, as src/polder/report/page.cpp writes it (docs/report-format.md).

export type FieldScale = "sequential" | "diverging" | "category";

export interface FieldDescription {
  key: string;
  label: string;
  symbol: string;
  unit: string;
  note: string;
  scale: FieldScale;
  shown: boolean;
  categories: string[];
  /** Of the categories, #rrggbb. */
  colours: string[];
  low: number;
  step: number;
  prediction: "time" | "neighbour" | "linear";
  blob: string;
}

export interface SetDescription {
  name: "soil" | "water";
  tracks: number;
  entries: number;
  spacing: number;
  blob: string;
  fields: FieldDescription[];
}

export interface Cell {
  text: string;
  /** For screen readers and as a tooltip. */
  title?: string;
  state?: "pass" | "fail";
}

export interface Table {
  id: string;
  title: string;
  note?: string;
  columns: string[];
  /** Columns of numbers, aligned to the right. */
  numeric: boolean[];
  rows: Cell[][];
}

export interface Fact {
  label: string;
  value: string;
  unit: string;
  note: string;
}

export interface HistoryColumn {
  name: string;
  unit: string;
}

export type Point = [number, number];

export interface Page {
  format: number;
  title: string;
  summary: string;
  status: "running" | "finished" | "failed" | "interrupted";
  reason: string;
  version: string;
  /** Seconds after which a page of a running run loads itself again; 0: never. */
  reload: number;
  size: Point;
  facts: Fact[];
  notes: string[];
  times: number[];
  sets: SetDescription[];
  outlines: Point[][];
  walls: Point[][];
  monitors: { name: string; points: Point[] }[];
  /** Still water over the ground along a line: (time, level). */
  levels: { name: string; line: Point[]; head: Point[] }[];
  history: { columns: HistoryColumn[]; values: (number | null)[][] };
  figures: { title: string; source: string }[];
  tables: Table[];
  inputs: unknown;
}

export function readPage(): Page {
  const element = document.getElementById("polder-page");
  if (!element?.textContent) throw new Error("this page has lost its data (no element polder-page)");
  return JSON.parse(element.textContent) as Page;
}
