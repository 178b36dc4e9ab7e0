"""pvpython every_step_in_paraview.py RUN: ParaView's reader finds at every time what the reader of python/ finds there."""

import pathlib
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import PVDReader
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import polder_results

run = polder_results.Run(sys.argv[1])
reader = PVDReader(FileName=str(run.folder / "points.pvd"))
assert list(reader.TimestepValues) == list(run.times), "other times"
values = 0
for snapshot in run:
    reader.UpdatePipeline(snapshot.time)
    data = servermanager.Fetch(reader)
    for part, points in enumerate((snapshot.soil, snapshot.water)):
        block = data.GetBlock(part)
        while block.IsA("vtkCompositeDataSet"):
            block = block.GetBlock(0)
        where = f"t = {snapshot.time}, {('soil', 'water')[part]}"
        assert block.GetNumberOfVerts() == len(points), where
        assert np.array_equal(vtk_to_numpy(block.GetPoints().GetData()), points.position), where
        arrays = block.GetPointData()
        names = [arrays.GetArray(k).GetName() for k in range(arrays.GetNumberOfArrays())]
        assert names == list(points.fields), f"{where}: {names}"
        for name in names:
            assert np.array_equal(vtk_to_numpy(arrays.GetArray(name)), points[name]), f"{where}: {name}"
            values += points[name].size
print(f"{len(run)} steps, {values} values, all the same")
