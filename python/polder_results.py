"""Reads the results of `polder run`: history.csv, points.pvd with its .vtp files, summary.json.

Needs numpy; pandas only for `History.to_pandas`. Put this folder on PYTHONPATH, or copy the file.

    import polder_results
    run = polder_results.Run("results/dike-seepage")
    run.history["crest settlement"]         # a column, m
    run.history.units["crest settlement"]   # "m"
    run.times                               # times of the snapshots, s
    soil = run.at(8.0).soil                 # the snapshot nearest to 8 s
    soil.position, soil["porosity"]         # arrays with one row per point

Everything is SI; stress is tension-positive, water pressure compression-positive. A tensor has the six components
xx, yy, zz, xy, yz, xz; `mean_effective_stress` and `deviatoric_stress` make invariants of the effective stress.
"""

import csv
import json
import pathlib
import re
import xml.etree.ElementTree as ElementTree

import numpy as np


class History:
    """history.csv: `names`, `units` by name, and a column of numbers for each name; "time" is among them."""

    def __init__(self, path):
        path = pathlib.Path(path)
        text = path.read_text(encoding="utf-8")
        if not text.endswith("\n"):  # a run that is writing: the last line is not whole
            text = text[: text.rfind("\n") + 1]
        rows = list(csv.reader(text.splitlines()))
        if not rows:
            raise ValueError(f"{path}: there is no header; 'polder run' writes such files")
        self.names, self.units = [], {}
        for head in rows[0]:
            name, unit = re.fullmatch(r"(.*?)(?: \[(.*)\])?", head).groups()
            self.names.append(name)
            self.units[name] = unit or ""
        for number, row in enumerate(rows[1:], start=2):
            if len(row) != len(self.names):
                raise ValueError(f"{path}:{number}: {len(row)} values under {len(self.names)} columns")
        self._columns = np.array([[float(v) for v in row] for row in rows[1:]]).reshape(-1, len(self.names)).T

    def __getitem__(self, name):
        if name not in self.names:
            raise KeyError(f"no column '{name}' in the history; there are: {', '.join(self.names)}")
        return self._columns[self.names.index(name)]

    def __len__(self):
        return self._columns.shape[1]

    def __iter__(self):
        return iter(self.names)

    def at(self, name, time):
        """The value of a column at a time, linear between rows; NaN outside of them."""
        return np.interp(time, self["time"], self[name], left=np.nan, right=np.nan)

    def to_pandas(self):
        """A DataFrame with the time as its index; needs pandas."""
        import pandas

        return pandas.DataFrame({name: self[name] for name in self.names}).set_index("time")


class Points:
    """The soil or the water of a snapshot: fields by name, one row per point. `position` is in m, `id` says which point
    it is, `volume` what it stands for (m³, or m² in plane strain)."""

    def __init__(self, position, fields):
        self.position, self.fields = position, fields

    def __getitem__(self, name):
        if name not in self.fields:
            raise KeyError(f"no field '{name}' in the snapshot; there are: {', '.join(self.fields)}")
        return self.fields[name]

    def __contains__(self, name):
        return name in self.fields

    def __len__(self):
        return len(self.position)

    @property
    def id(self):
        return self.fields["id"]

    @property
    def volume(self):
        return self.fields["volume"]

    def mean_effective_stress(self):
        """-tr(stress)/3, Pa: compression-positive, as soil mechanics has it."""
        return -self["effective_stress"][:, :3].sum(axis=1) / 3

    def deviatoric_stress(self):
        """sqrt(3/2 s:s), Pa."""
        stress = np.asarray(self["effective_stress"], dtype=float)
        deviator = stress[:, :3] - stress[:, :3].mean(axis=1, keepdims=True)
        return np.sqrt(1.5 * ((deviator**2).sum(axis=1) + 2 * (stress[:, 3:] ** 2).sum(axis=1)))


class Snapshot:
    """One instant: `time` (s), `soil` and `water` (Points)."""

    def __init__(self, time, soil, water):
        self.time, self.soil, self.water = time, soil, water


class Run:
    """The folder of a run, finished or going on. Snapshots are read when they are asked for."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "history.csv").exists():
            raise FileNotFoundError(f"{self.folder}: there is no history.csv; give the --out of a run")
        self.history = History(self.folder / "history.csv")
        self.summary = self._json("summary.json")  # None while the run goes on
        self.section = self._json("points/section.json")  # title, dimension, size, outlines, walls; None before the first snapshot
        series = self.folder / "points.pvd"
        self._files = {}
        if series.exists():
            for entry in ElementTree.parse(series).getroot().iter("DataSet"):
                self._files.setdefault(float(entry.get("timestep")), {})[entry.get("name")] = entry.get("file")
        self.times = np.array(sorted(self._files))

    def _json(self, name):
        path = self.folder / name
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None

    def __len__(self):
        return len(self.times)

    def snapshot(self, number):
        """By number; negative ones count from the end."""
        time = self.times[number]
        parts = {name: read_vtp(self.folder / file) for name, file in self._files[time].items()}
        return Snapshot(float(time), parts["soil"], parts["water"])

    def at(self, time):
        """The snapshot nearest to a time (s)."""
        if not len(self):
            raise ValueError(f"{self.folder}: there are no snapshots; output.snapshots of the case asks for them")
        return self.snapshot(int(np.argmin(np.abs(self.times - time))))

    def __iter__(self):
        return (self.snapshot(k) for k in range(len(self)))


_types = {"Float32": "<f4", "Float64": "<f8", "Int64": "<i8", "Int32": "<i4"}


def read_vtp(path):
    """The points of a .vtp that Polder wrote (raw appended data, not compressed; no VTK files in general)."""
    data = pathlib.Path(path).read_bytes()
    begin = data.find(b'<AppendedData encoding="raw">')
    start = data.find(b"_", begin) + 1
    if begin < 0 or not data.endswith(b"</VTKFile>\n"):
        raise ValueError(f"{path}: not a whole .vtp of Polder's")
    header = ElementTree.fromstring(data[:begin].decode("utf-8") + "</VTKFile>")
    piece = header.find("PolyData/Piece")
    count = int(piece.get("NumberOfPoints"))

    def array(element):
        at = start + int(element.get("offset"))
        size = int(np.frombuffer(data, "<u8", 1, at)[0])
        components = int(element.get("NumberOfComponents"))
        kind = np.dtype(_types[element.get("type")])
        if size != count * components * kind.itemsize:
            raise ValueError(f"{path}: the array '{element.get('Name')}' has {size} bytes for {count} points")
        values = np.frombuffer(data, kind, count * components, at + 8)
        return values if components == 1 else values.reshape(count, components)

    fields = {element.get("Name"): array(element) for element in piece.find("PointData")}
    return Points(array(piece.find("Points/DataArray")), fields)
