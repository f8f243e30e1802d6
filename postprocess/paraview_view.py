"""Opens the output folder of a run in ParaView, with curved bodies drawn exactly.

    pvpython --script=postprocess/paraview_view.py FOLDER [picture.png]
    paraview --script=postprocess/paraview_view.py        (asks nothing, opens .)

Bodies are rational Bezier cells: Nonlinear Subdivision Level says into how many
pieces ParaView cuts each for drawing; at its default of 1 they look faceted."""

import glob
import os
import sys

from paraview import simple

SUBDIVISION = 3


def field_of(source, word):
    names = source.CellData.keys() if word == "vorticity" else source.PointData.keys()
    return next((name for name in names if name.startswith(word)), None)


def show_flow(path, view):
    flow = simple.PVDReader(FileName=path)
    display = simple.Show(flow, view)
    name = field_of(flow, "vorticity")
    if name:
        simple.ColorBy(display, ("CELLS", name))
        display.RescaleTransferFunctionToDataRange(False)
        simple.GetColorTransferFunction(name).ApplyPreset("Cool to Warm", True)
    return flow


def show_body(path, view):
    body = simple.PVDReader(FileName=path)
    display = simple.Show(body, view)
    display.Representation = "Surface"
    display.NonlinearSubdivisionLevel = SUBDIVISION
    name = field_of(body, "activation")
    if name:
        simple.ColorBy(display, ("POINTS", name))
    else:
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = [0.3, 0.3, 0.3]
    return body


def main(folder=".", picture=None):
    view = simple.GetActiveViewOrCreate("RenderView")
    view.InteractionMode = "2D"
    for path in sorted(glob.glob(os.path.join(folder, "*.pvd"))):
        (show_flow if os.path.basename(path) == "flow.pvd" else show_body)(path, view)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().GoToLast()
    view.ResetCamera()
    simple.Render(view)
    if picture:
        simple.SaveScreenshot(picture, view)


if __name__ in ("__main__", "__vtkconsole__"):
    main(*[argument for argument in sys.argv[1:] if not argument.startswith("-")][:2])
