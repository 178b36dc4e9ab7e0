# pvpython read_with_paraview.py points.pvd: what ParaView's own reader finds at the last time, one line per part:
# name, points, vertices, then every array with its components and the sum of its values.
import sys

from paraview import servermanager
from paraview.simple import PVDReader

reader = PVDReader(FileName=sys.argv[1])
times = list(reader.TimestepValues)
reader.UpdatePipeline(times[-1])
data = servermanager.Fetch(reader)
print("times", *times)
for i in range(data.GetNumberOfBlocks()):
    points = data.GetBlock(i)
    while points.IsA("vtkCompositeDataSet"):
        points = points.GetBlock(0)
    print(data.GetMetaData(i).Get(data.NAME()), points.GetNumberOfPoints(), points.GetNumberOfVerts())
    arrays = points.GetPointData()
    for k in range(arrays.GetNumberOfArrays()):
        array = arrays.GetArray(k)
        components = array.GetNumberOfComponents()
        total = sum(array.GetComponent(t, c) for t in range(array.GetNumberOfTuples()) for c in range(components))
        print(" ", array.GetName(), components, repr(total))
