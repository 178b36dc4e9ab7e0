"""pvpython picture_shows.py FILE.png: the picture of python/paraview_first_picture.py has white, the water's blue and many
colours of the soil, and what it shows reaches across it."""

import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

reader = vtkPNGReader()
reader.SetFileName(sys.argv[1])
reader.Update()
image = reader.GetOutput()
width, height, _ = image.GetDimensions()
picture = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(int)
white = (picture > 250).all(axis=2)
blue = (np.abs(picture - [194, 224, 242]) < 6).all(axis=2)
columns = np.flatnonzero(~white.all(axis=0))
shades = len(np.unique(picture[~white & ~blue] // 16, axis=0))
print(f"{width} x {height}: white {white.mean():.2f}, water {blue.mean():.3f}, {shades} other colours")
assert 0.5 < white.mean() < 0.95 and blue.mean() > 0.05 and shades > 30
assert columns[0] < 0.1 * width and columns[-1] > 0.9 * width
