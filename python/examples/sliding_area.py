# %% [markdown]
# # How much of a slope slides, from the snapshots of a run
# On every vertical of the ground as it was at the start: the soil above the level below which displacements are less than
# half of the largest on it. `polder stability` measures the mechanism of strength reduction in the same way.
#
#     polder run dike-seepage-fem --out results/dike
#     python3 python/examples/sliding_area.py results/dike 2 6 14

# %%
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import polder_results


def sliding_area(start, displacement, area, columns=20, rows=40):
    """`start`: positions (x, height) of the points, `displacement`: its size, `area`: what each stands for, m2."""
    low, high = start.min(axis=0), start.max(axis=0)
    column = np.minimum(((start[:, 0] - low[0]) / (high[0] - low[0]) * columns).astype(int), columns - 1)
    row = np.minimum(((high[1] - start[:, 1]) / (high[1] - low[1]) * rows).astype(int), rows - 1)
    total = 0.0
    for c in range(columns):
        here = column == c
        filled = np.unique(row[here])  # from the top down
        if len(filled) == 0:
            continue
        profile = np.array([displacement[here & (row == r)].mean() for r in filled])
        top = profile.argmax()
        below = np.flatnonzero(profile[top:] < profile[top] / 2)
        last = top + below[0] if len(below) else len(filled)
        total += area[here & np.isin(row, filled[:last])].sum()
    return total


# %%
if __name__ == "__main__":
    run = polder_results.Run(sys.argv[1])
    first = run.at(0.0).soil
    order = np.argsort(first.id)
    start, area = first.position[order][:, :2], first.volume[order]
    for time in map(float, sys.argv[2:]):
        soil = run.at(time).soil
        moved = soil.position[np.argsort(soil.id)][:, :2] - start
        print(f"{time:g} s: {sliding_area(start, np.linalg.norm(moved, axis=1), area):.4f} m2 of {area.sum():.4f}")
