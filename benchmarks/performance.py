#!/usr/bin/env python3
"""Measures the speed of Polder on this machine and writes docs/performance.md: a quarter of an hour on an idle machine.

    benchmarks/performance.py [--reference FOLDER] [--repeats N]

FOLDER has the frozen reference programs (mac_bench.cpp, mac_dike.cpp and their headers); without it their rows are left
out. Needs build/release with polder and, for the kernels, step_benchmark (POLDER_BENCHMARKS=ON); valgrind for
instructions. What cannot be measured by a script is in benchmarks/performance-notes.md, which ends the page.
"""
import argparse
import datetime
import json
import os
import pathlib
import platform
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
POLDER = ROOT / "build/release/polder"
ENVIRONMENT = dict(os.environ, OMP_WAIT_POLICY="passive")
median = statistics.median


def say(text):
    print(text, file=sys.stderr, flush=True)


def run(command, **more):
    """Output, CPU seconds and wall seconds of a command."""
    say("  " + " ".join(str(part) for part in command))
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, env=ENVIRONMENT, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise SystemExit(f"{command}: exit {done.returncode}\n{done.stderr[-2000:]}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.stdout, cpu, time.monotonic() - start


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def listed(values, form="{:.1f}"):
    return ", ".join(form.format(v) for v in values)


class Measurements:
    def __init__(self, reference, repeats, work):
        self.reference, self.repeats, self.work = reference, repeats, work

    def case(self, name, *overrides, threads=1, until=None):
        """Summary and CPU seconds of a run, its peak memory (MB)."""
        out = self.work / "run"
        shutil.rmtree(out, ignore_errors=True)
        command = [POLDER, "run", name, "--threads", threads, "--quiet", "--out", out]
        for override in overrides:
            command += ["--set", override]
        if until is not None:
            command += ["--until", until]
        memory = self.work / "memory"
        _, cpu, _ = run(["/usr/bin/time", "-f", "%M", "-o", memory] + command)
        return json.loads((out / "summary.json").read_text()), cpu, float(memory.read_text()) * 1024 / 1e6

    def block(self, space, points, threads):
        out = self.work / "bench.json"
        run([POLDER, "bench", "--space", space, "--points", points, "--steps", 10, "--threads", threads, "--json", out])
        return json.loads(out.read_text())[0]

    def blocks(self):
        rows, kernels, ratios = [], [], []
        names = {"plane-strain": "plane strain", "3d": "3d"}
        for space, name in names.items():
            small = [self.block(space, 100000, 1) for _ in range(self.repeats)]
            one, two = [], []
            for _ in range(self.repeats):  # in turn, so that both meet the same machine
                one.append(self.block(space, 1000000, 1))
                two.append(self.block(space, 1000000, 2))
            speed = lambda runs: [r["points_per_second"] / 2e6 for r in runs]
            for runs in (small, one, two):
                first = runs[0]
                points = first["soil_points"] + first["water_points"]
                rows.append([name, points, first["threads"], f"{median(speed(runs)):.2f}", listed(speed(runs), "{:.2f}"),
                             f"{first['pressure_iterations_per_step']:.1f}",
                             f"{median(r['pressure_ns_per_unknown_and_iteration'] for r in runs):.1f}"])
                of = lambda key: median(1e9 * r["kernel_seconds"][key] / points / r["steps"] for r in runs)
                kernels.append([name, points, first["threads"]] + [f"{of(key):.1f}" for key in first["kernel_seconds"]])
            several = [b["points_per_second"] / a["points_per_second"] for a, b in zip(one, two)]
            ratios.append([name, f"{median(several):.2f}", listed(several, "{:.2f}")])
            growth = [(b["bytes_per_point"] * (b["soil_points"] + b["water_points"]) -
                       a["bytes_per_point"] * (a["soil_points"] + a["water_points"])) /
                      (b["soil_points"] + b["water_points"] - a["soil_points"] - a["water_points"])
                      for a, b in zip(small, one)]
            ratios[-1].append(f"{median(growth):.0f}")
        keys = [key.replace("_", " ") for key in one[0]["kernel_seconds"]]
        return f"""## Whole steps of large blocks

`polder bench`: a saturated block of `dike-seepage`'s sand at rest, as many points of water as of soil (2 per axis and cell), with
pressure solve and volume correction; no sort falls into the ten timed steps. Aims with 10⁶ points of each and one thread: 3.5
million pairs of points a second in plane strain, 2.4 in 3d; two threads 1.7 times as fast; resident memory that grows by at most
300 bytes a point in plane strain and 400 in 3d.

{table(["space", "points, both phases", "threads", "million pairs/s, median", "each run", "pressure iterations",
        "ns per unknown and iteration"], rows)}
{table(["space", "two threads over one, median", "each pair", "bytes a point between the two sizes"], ratios)}
ns per point and step, by kernel:

{table(["space", "points", "threads"] + keys, kernels)}"""

    def instructions(self):
        output, _, _ = run(["bash", ROOT / "tests/all.d/instructions.sh"])
        count = {m[1]: int(m[2]) for m in re.finditer(r"(\S+)\s+(\d+)\s+limit", output)}
        aims = {"plane-strain": (420, 550), "3d": (1200, 1500)}
        rows = []
        for space, (water, soil) in aims.items():
            of = lambda phase: count[f"{space}.{phase}_to_grid"] + count[f"{space}.grid_to_{phase}"]
            rows.append([space.replace("-", " "), of("water"), water, of("soil"), soil])
        kernels = sorted({name.split(".")[1] for name in count})
        parts = [[name.replace("_", " ")] + [count[f"{space}.{name}"] for space in aims] for name in kernels]
        return f"""## Instructions

Per point and step, counted by callgrind (`tests/all.d/instructions.sh`, with limits in `benchmarks/instructions.limits`), to the
grid and back, Drucker–Prager:

{table(["space", "water", "aim", "soil", "aim"], rows)}
By kernel (`update soil` is part of `grid to soil`; faces and solves per soil point):

{table(["kernel", "plane strain", "3d"], parts)}"""

    def kernels(self):
        if not self.reference or not (ROOT / "build/release/step_benchmark").exists():
            return ""
        rows = []
        for _ in range(self.repeats):
            output, _, _ = run(["bash", ROOT / "benchmarks/against_reference.sh", self.reference])
            for part in output.split("d, ns a point:")[1:]:
                value = lambda name: float(re.search(re.escape(name) + r"\s+([\d.]+)", part)[1])
                rows.append(["plane strain" if len(rows) % 2 == 0 else "3d", f"{value('reference c1'):.1f}",
                             f"{value('pair'):.0f}", f"{value('pair') / value('reference c1'):.2f}",
                             f"{value('reference w_row + s_row'):.0f}"])
        return f"""## Against the frozen collocated kernel

One point of soil and one of water (to the grid, faces, back, a sort every 20 steps) beside "c1" (one phase, transfers and stress
only), both with 10⁶ points of a phase in the same minute, one thread, ns a point (`benchmarks/against_reference.sh`). The aim is
a ratio of at most 4.0. What the frozen kernels do not have is in ours: boxes that fill cells, drag of both phases, water that is
advected by the flux through its own cell, F-bar, walls.

{table(["space", "c1", "pair", "ratio", "the one-file staggered kernels, same pair"], sorted(rows))}"""

    def dike(self):
        fine = "model.cell=0.025 m"
        prototype = None
        if self.reference:
            prototype = self.work / "mac_dike"
            run(["g++", "-O3", "-march=native", "-std=c++20", "-w", f"{self.reference}/mac_dike.cpp", "-o", prototype])
        rows = []
        for cell, overrides, repeats in (("0.05 m", [], self.repeats), ("0.025 m", [fine], 1)):
            ours, theirs = [], []
            for _ in range(repeats):
                whole, cpu, _ = self.case("dike-seepage", *overrides)
                ours.append(cpu)
                if prototype:
                    theirs.append(run([prototype, "case=dike", f"h={cell[:-2]}", "cfl=0.8"], cwd=self.work)[1])
            rows.append([cell, listed(ours), listed(theirs) if theirs else "not measured",
                         f"{median(ours) / median(theirs):.2f}" if theirs else "", "0.5" if cell == "0.05 m" else "0.4"])
        walls, hashes, kernels = {1: [], 2: []}, set(), {}
        for _ in range(self.repeats):
            for threads in walls:
                summary = self.case("dike-seepage", fine, threads=threads, until=3)[0]
                walls[threads].append(summary["wall_seconds"])
                hashes.add(summary["state_hash"])
                kernels[threads] = summary["kernel_seconds"]
        ratio = [a / b for a, b in zip(walls[1], walls[2])]
        same = "the state is the same to the last bit" if len(hashes) == 1 else "THE STATES DIFFER"
        by_kernel = [[key.replace("_", " "), f"{kernels[1][key]:.2f}", f"{kernels[2][key]:.2f}"] for key in kernels[1]]
        over = self.case("overtopping", until=0.3)[0]
        return f"""## The dike, 23 s

`dike-seepage` on one thread with all its output, CPU seconds, in turn with the one-file prototype of the same step (CFL 0.8, no
output):

{table(["cell", "polder", "prototype", "ratio", "aim"], rows)}
To 3 s with cells of 0.025 m, wall seconds, in turn: {listed(walls[1])} with one thread, {listed(walls[2])} with two: {median(ratio):.2f}
times as fast (aim 1.7; {listed(ratio, "{:.2f}")}); {same}. By kernel, s (the last pair):

{table(["kernel", "one thread", "two"], by_kernel)}
Pressure iterations a step (aim: at most 12): {whole["pressure_iterations_per_step"]:.1f} in the dike, {over["pressure_iterations_per_step"]:.1f} in
`overtopping`. With a jump of 1e6 between clay and sand beside a sheet pile, and as cells are halved, they are bounded by
`tests/grid/pressure_solver_test.cpp`; hypre beside them is in [decisions](decisions.md).
"""

    def predictions(self):
        rows = []
        for name in ("dike-seepage", "dike-paper-darcy", "granular-column", "water-column"):
            command = [POLDER, "check", name, "--json", "--no-drawing"]
            predicted = json.loads(run(command)[0])
            _, cpu, peak = self.case(name)
            rows.append([name, f"{predicted['estimated_memory_bytes'] / 1e6:.0f}", f"{peak:.0f}",
                         f"{predicted['estimated_wall_seconds']:.0f}", f"{cpu:.0f}"])
        return f"""## What `polder check` predicts

Peak resident memory with the report at the end, which holds the points of all snapshots that the page moves; one core:

{table(["case", "predicted, MB", "measured, MB", "predicted, s", "measured, CPU s"], rows)}"""

    def unsaturated(self):
        whole, cpu, _ = self.case("levee-uplift-paper")
        uniform = ("numerics.step_stretch=1", "numerics.mass_scaling=100")
        scaled, cpu_scaled, _ = self.case("levee-uplift-paper", *uniform, "numerics.step_material=clay")
        partly, cpu_partly, _ = self.case("levee-uplift-paper", *uniform, until=120)
        start, cpu_start, _ = self.case("levee-uplift-paper", *uniform, until=60)
        steps, seconds = partly["steps"] - start["steps"], cpu_partly - cpu_start
        minutes = whole["simulated_time"] / 60
        return f"""## Unsaturated runs

`levee-uplift-paper`, five phases, {minutes:.0f} minutes, {whole["soil_points"]} points, one thread:

| inertia and steps | steps | CPU minutes | aim |
|---|---|---|---|
| adaptive, as shipped | {whole["steps"]} | {cpu / 60:.1f} | 3 |
| 100 times the mass (the paper's scaling), the clay's natural step; stiffer sand as much as that asks for | {scaled["steps"]} | {cpu_scaled / 60:.1f} | 10 |
| 100 times the mass everywhere, the sand's natural step (from one minute of it, {1e3 * seconds / steps:.2f} ms a step) | {minutes * steps / 1e6:.2f} million | {minutes * seconds / 60:.0f} | |
"""

    def factors(self):
        rows = []
        for what, *command in (
                ("Bishop, search of at most 5 340 circles, and 9 261 more for the contours", "stability",
                 "griffiths-lane-1", "--method", "bishop", "--contours"),
                ("Uplift-Van, search, with the seepage that it reads", "stability", "levee-stability-2", "--method", "uplift-van"),
                ("strength reduction, 4 941 triangles", "stability", "acads-1a", "--method", "srm", "--set",
                 "stability.triangles=5000")):
            seconds = [run([POLDER, *command], cwd=self.work)[2] for _ in range(self.repeats)]
            rows.append([f"`polder {' '.join(command)}`: {what}", f"{median(seconds):.2f}"])
        return f"""## Factors of safety

The whole command, wall seconds, median of {self.repeats}:

{table(["what", "s"], rows)}"""


def machine():
    model = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    compiler = subprocess.run(["c++", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    return f"{os.cpu_count()} processors ({model[1] if model else platform.machine()}), {compiler}, the `release` preset"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", help="folder of the frozen reference programs")
    parser.add_argument("--repeats", type=int, default=3, help="how often each figure is measured (default 3)")
    parser.add_argument("--only", nargs="*", default=[], help="print these sections instead of writing the page")
    arguments = parser.parse_args()
    sections = ["blocks", "instructions", "kernels", "dike", "predictions", "unsaturated", "factors"]
    with tempfile.TemporaryDirectory() as folder:
        measured = Measurements(arguments.reference, arguments.repeats, pathlib.Path(folder))
        text = {}
        for section in arguments.only or sections:
            say(section)
            text[section] = getattr(measured, section)()
    if arguments.only:
        print("\n".join(text.values()))
        return
    page = f"""# Performance

Written by `benchmarks/performance.py` on {datetime.date.today()}: {machine()}. Machines are shared and differ, so
ratios count more than figures; each figure is a median, or all that were measured are given.

""" + "\n".join(part for part in text.values() if part) + "\n" + (ROOT / "benchmarks/performance-notes.md").read_text()
    (ROOT / "docs/performance.md").write_text(page)


if __name__ == "__main__":
    main()
