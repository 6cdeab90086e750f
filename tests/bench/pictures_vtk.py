# SPDX-License-Identifier: GPL-3.0-or-later
"""The same beads with VTK, as spheres in 1920 x 1080; without profile and space-time image, which it has no ready part for.
   pictures_vtk.py RUN.h5 OUT.mp4 FRAMES"""
import subprocess
import sys

import h5py
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SIZE = 1920, 1080


def colours():
    table = vtk.vtkColorTransferFunction()
    for force, rgb in ((0, (0.45, 0.47, 0.52)), (15, (0.47, 0.11, 0.43)), (30, (0.93, 0.41, 0.15)), (45, (0.99, 1.0, 0.64))):
        table.AddRGBPoint(force, *rgb)
    return table


def main(run, out, frames):
    with h5py.File(run) as f:
        chain = f["particles/chain"]
        force = chain["bead_force/value"][:]
        move = chain["displacement/value"][:]
        place, radius, own = chain["rest_position"][:], chain["radius"][:], chain["chain"][:]
    count = len(place)
    centre = np.zeros((count, 3))
    centre[:, 1] = -0.25 * place.max() * (own - own.min())
    points, values = vtk.vtkPoints(), vtk.vtkFloatArray()
    values.SetName("force")
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    size = numpy_to_vtk(2 * radius.astype(np.float32), deep=True)
    size.SetName("size")
    data.GetPointData().AddArray(size)
    ball = vtk.vtkSphereSource()
    ball.SetRadius(0.5)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(24)
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(data)
    mapper.SetSourceConnection(ball.GetOutputPort())
    mapper.SetScaleArray("size")
    mapper.SetScaleModeToScaleByMagnitude()
    mapper.SetLookupTable(colours())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("force")
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    label = vtk.vtkTextActor()
    label.GetTextProperty().SetFontSize(36)
    scene = vtk.vtkRenderer()
    scene.AddActor(actor)
    scene.AddActor(label)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*SIZE)
    window.AddRenderer(scene)
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    encoder = subprocess.Popen(
        ["ffmpeg", "-nostdin", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", "%dx%d" % SIZE, "-r", "60", "-i", "-",
         "-vf", "vflip", "-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p", out], stdin=subprocess.PIPE)
    for i in range(frames):
        sample = i * (len(force) - 1) // 599
        centre[:, 0] = place + 200 * move[sample]
        points.SetData(numpy_to_vtk(centre, deep=True))
        now = numpy_to_vtk(force[sample].astype(np.float32), deep=True)
        now.SetName("force")
        data.GetPointData().AddArray(now)
        data.Modified()
        label.SetInput(f"t = {sample} us")
        if i == 0:
            scene.ResetCamera()
            scene.GetActiveCamera().Zoom(1.6)
        window.Render()
        grab.Modified()
        grab.Update()
        encoder.stdin.write(vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).tobytes())
    encoder.stdin.close()
    return encoder.wait()


sys.exit(main(sys.argv[1], sys.argv[2], int(sys.argv[3])))
