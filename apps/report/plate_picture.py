# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws a quarter plate run at four times, particles coloured by plastic strain.

    xvfb-run -a pvbatch apps/report/plate_picture.py results/demo plate

writes plate-0.png .. plate-3.png. Needs the distribution's packages paraview,
python3-paraview and xvfb.
"""
import sys

from paraview import simple as pv

directory, picture = sys.argv[1], sys.argv[2]

run = pv.Xdmf3ReaderS(FileName=[directory + "/results.xdmf"])
run.UpdatePipeline()
times = list(run.TimestepValues)
# mesh nodes have no radius, particles half their spacing
particles = pv.Threshold(Input=run, Scalars=["POINTS", "radius"], ThresholdMethod="Between",
                         LowerThreshold=1e-9, UpperThreshold=1.0)

view = pv.CreateView("RenderView")
view.ViewSize = [480, 640]
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0

mesh = pv.Show(run, view)
mesh.Representation = "Surface With Edges"
pv.ColorBy(mesh, None)
mesh.DiffuseColor = [0.82, 0.84, 0.87]
mesh.EdgeColor = [0.45, 0.47, 0.5]

dots = pv.Show(particles, view)
dots.Representation = "Point Gaussian"
dots.ShaderPreset = "Sphere"
dots.GaussianRadius = 0.00045
pv.ColorBy(dots, ("POINTS", "plastic_strain"))
strain = pv.GetColorTransferFunction("plastic_strain")
strain.ApplyPreset("Viridis (matplotlib)", True)
strain.RescaleTransferFunction(0.0, 1.0)
bar = pv.GetScalarBar(strain, view)
bar.Title, bar.ComponentTitle = "plastic strain", ""
bar.TitleColor = bar.LabelColor = [0, 0, 0]
bar.WindowLocation = "Lower Right Corner"

label = pv.Text()
shown = pv.Show(label, view)
shown.Color, shown.FontSize, shown.WindowLocation = [0, 0, 0], 20, "Upper Left Corner"

# towards the two cut faces, level with the plate
view.CameraFocalPoint = [0.0, 0.0, 0.008]
view.CameraPosition = [-0.15, -0.15, 0.05]
view.CameraViewUp = [0, 0, 1]
view.CameraParallelProjection = 1
view.CameraParallelScale = 0.05

for k in range(4):
    time = times[round(k * (len(times) - 1) / 3)]
    view.ViewTime = time
    label.Text = f"{time * 1e6:.0f} us"
    dots.SetScalarBarVisibility(view, k == 3)
    pv.SaveScreenshot(f"{picture}-{k}.png", view, ImageResolution=[480, 640])
