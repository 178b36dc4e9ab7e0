"""A good first picture of a run in ParaView (5.11): soil coloured by a field, water behind it, seen squarely, with time
and colour bar.

    pvpython paraview_first_picture.py results/dike-seepage --field porosity --time 8 --out dike.png
    pvpython paraview_first_picture.py results/dike-seepage --state dike.pvsm     # then: paraview dike.pvsm

As a macro in ParaView (Macros > Import new macro) it dresses up the points.pvd that is open.
"""

import argparse
import json
import os
import sys

from paraview import servermanager
from paraview import simple as pv


def block_of(reader, name):
    """Soil or water alone, so that each is coloured and hidden by itself."""
    block = pv.ExtractBlock(registrationName=name, Input=reader, Selectors=[f"/Root/{name}"])
    pv.UpdatePipeline(proxy=block)
    return block


def spacing_of(block, dimension):
    """Side of the square (cube) that a point stands for, m."""
    volume = block.PointData.GetArray("volume")
    return volume.GetRange()[1] ** (1 / dimension) if volume else 0.0


def show(block, view, spacing):
    """Points as discs that touch each other."""
    display = pv.Show(block, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Plain circle"
    display.GaussianRadius = 0.6 * spacing
    return display


def seen_squarely(view, section):
    """The section fills the view; x to the right, height up."""
    width, height = section["size"][0], section["size"][2 if section["dimension"] == 3 else 1]
    middle = [width / 2, section["size"][1] / 2 if section["dimension"] == 3 else height / 2, 0]
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    if section["dimension"] == 3:
        view.CameraFocalPoint = [middle[0], middle[1], height / 2]
        view.CameraPosition = [middle[0], middle[1] - 10 * width, height / 2]
        view.CameraViewUp = [0, 0, 1]
    else:
        view.CameraFocalPoint = middle
        view.CameraPosition = [middle[0], middle[1], 10 * width]
        view.CameraViewUp = [0, 1, 0]
    pixels = view.ViewSize
    view.CameraParallelScale = 0.55 * max(height, width * pixels[1] / pixels[0])


def dress(reader, section, field, view):
    pv._DisableFirstRenderCameraReset()
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    pv.Hide(reader, view)
    water, soil = block_of(reader, "water"), block_of(reader, "soil")
    spacing = spacing_of(soil, section["dimension"]) or spacing_of(water, section["dimension"])
    wet = show(water, view, spacing)
    wet.ColorArrayName = ["POINTS", ""]
    wet.DiffuseColor = wet.AmbientColor = [0.76, 0.88, 0.95]
    display = show(soil, view, spacing)
    if soil.PointData.GetArray(field) is None:
        names = [soil.PointData.GetArray(k).Name for k in range(soil.PointData.GetNumberOfArrays())]
        sys.exit(f"there is no field '{field}' in the soil; there are: {', '.join(names)}")
    pv.ColorBy(display, ("POINTS", field))
    display.RescaleTransferFunctionToDataRange(False, True)
    pv.GetColorTransferFunction(field).ApplyPreset("Inferno (matplotlib)", True)
    pv.GetColorTransferFunction(field).InvertTransferFunction()
    bar = pv.GetScalarBar(pv.GetColorTransferFunction(field), view)
    bar.Title, bar.ComponentTitle = field.replace("_", " "), ""
    bar.TitleColor = bar.LabelColor = [0.15, 0.15, 0.15]
    bar.RangeLabelFormat = "%-#.3g"
    bar.Orientation, bar.WindowLocation = "Horizontal", "Lower Center"
    display.SetScalarBarVisibility(view, True)
    label = pv.Show(pv.AnnotateTimeFilter(Input=reader, Format="t = {time:.2f} s"), view)
    label.Color, label.WindowLocation, label.FontSize = [0.15, 0.15, 0.15], "Upper Right Corner", 18
    seen_squarely(view, section)


def section_of(folder):
    with open(os.path.join(folder, "points", "section.json"), encoding="utf-8") as file:
        return json.load(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="of a run")
    parser.add_argument("--field", default="deviatoric_strain")
    parser.add_argument("--time", type=float, help="s; without it the last snapshot")
    parser.add_argument("--out", help="picture to write, .png")
    parser.add_argument("--state", help="state to write for ParaView, .pvsm")
    arguments = parser.parse_args()
    reader = pv.PVDReader(registrationName="run", FileName=os.path.abspath(os.path.join(arguments.folder, "points.pvd")))
    times = list(reader.TimestepValues)
    wanted = times[-1] if arguments.time is None else min(times, key=lambda t: abs(t - arguments.time))
    view = pv.CreateRenderView()
    view.ViewSize = [1280, 480]
    pv.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    pv.GetAnimationScene().AnimationTime = view.ViewTime = wanted
    pv.UpdatePipeline(time=wanted, proxy=reader)
    dress(reader, section_of(arguments.folder), arguments.field, view)
    pv.Render(view)
    if arguments.out:
        pv.SaveScreenshot(arguments.out, view, ImageResolution=[1280, 480])
    if arguments.state:
        pv.SaveState(arguments.state)


def macro():
    readers = [source for source in pv.GetSources().values() if isinstance(source, servermanager.sources.PVDReader)]
    if not readers:
        raise RuntimeError("open a points.pvd of Polder first, and press Apply")
    reader = readers[-1]
    view = pv.GetActiveViewOrCreate("RenderView")
    dress(reader, section_of(os.path.dirname(str(reader.FileName))), "deviatoric_strain", view)
    pv.Render(view)


if __name__ == "__main__":
    main()
else:
    macro()
