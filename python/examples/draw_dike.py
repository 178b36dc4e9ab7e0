# %% [markdown]
# # A figure from the results of a run
# Run cell by cell in an editor that knows `# %%`, or as a whole:
#
#     polder run dike-seepage --out results/dike-seepage
#     python3 python/examples/draw_dike.py results/dike-seepage dike.png
#
# It prints what it reads; the figure needs matplotlib.

# %%
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import polder_results

folder = sys.argv[1] if len(sys.argv) > 1 else "results/dike-seepage"
picture = sys.argv[2] if len(sys.argv) > 2 else "dike.png"
run = polder_results.Run(folder)
print(f"{run.section['title']}: {len(run)} snapshots to {run.times[-1]:.3g} s, {len(run.history)} rows of history")

# %% [markdown]
# ## Mean displacement, from the snapshots and from the history
# The volume that a point stands for grows with its porosity, so grains are the weight.

# %%
times, means = [], []
for snapshot in run:
    soil = snapshot.soil
    grains = soil.volume * (1 - soil["porosity"])
    times.append(snapshot.time)
    means.append(np.average(np.linalg.norm(soil["displacement"], axis=1), weights=grains))
last = run.snapshot(-1)
print(f"mean displacement at {last.time:.3g} s: {means[-1]:.4f} m from the points, "
      f"{run.history.at('mean soil displacement', last.time):.4f} m in the history")

# %% [markdown]
# ## Stress along a vertical

# %%
first = run.snapshot(0).soil
near = np.abs(first.position[:, 0] - first.position[:, 0].min()) < 0.1
order = np.argsort(first.position[near, 1])
for y, p in list(zip(first.position[near, 1][order], first.mean_effective_stress()[near][order]))[::8]:
    print(f"  y = {y:5.3f} m: mean effective stress {p / 1e3:6.2f} kPa")

# %% [markdown]
# ## The figure

# %%
try:
    import matplotlib
except ImportError:
    print("matplotlib is not installed: no figure")
    sys.exit()
matplotlib.use("Agg")
import matplotlib.pyplot as plt

figure, (above, below) = plt.subplots(2, 1, figsize=(8, 5), height_ratios=[1.2, 1], layout="constrained")
soil, water = last.soil, last.water
width = run.section["size"][0]
dot = (8 * 72 / width * np.sqrt(np.median(soil.volume))) ** 2  # about what a point stands for, in points squared
above.scatter(*water.position[:, :2].T, s=dot, marker="s", color="#c3e0f2", linewidths=0)
shown = above.scatter(*soil.position[:, :2].T, s=dot, c=soil["deviatoric_strain"], marker="s", cmap="inferno_r",
                      vmin=0, vmax=np.quantile(soil["deviatoric_strain"], 0.98), linewidths=0)
for outline in run.section["outlines"]:
    above.plot(*np.array(outline).T, "k--", linewidth=0.8)
figure.colorbar(shown, ax=above, label="deviatoric strain", extend="max")
above.set(aspect="equal", xlabel="x (m)", ylabel="y (m)", title=f"{run.section['title']}, t = {last.time:.1f} s")
below.plot(run.history["time"], run.history["mean soil displacement"], label="history.csv")
below.plot(times, means, ".", label="snapshots")
below.set(xlabel="time (s)", ylabel="mean displacement (m)")
below.legend()
figure.savefig(picture, dpi=150)
print(picture)
