"""Renders a scene of a pack with VTK, into an X window that need not be visible (Xvfb).

Ways, each VTK's own code: `dual` (vtkDualDepthPeelingPass, selected by SetUseDepthPeeling(1)), `peeling` (vtkDepthPeelingPass, selected if dual is
not supported) and `weighted` (vtkOrderIndependentTranslucentPass, without depth peeling). Colours are uniforms, properties of one actor per sequence
of triangles of one colour, so that they are not rounded to 8 bits. Lighting is off.
"""
WAYS = ["dual", "peeling", "weighted"]
PEELS = 4  # vtkRenderer.cxx: MaximumNumberOfPeels


def matrix_of(vtk, columns):
    """VTK's matrices are row by row."""
    matrix = vtk.vtkMatrix4x4()
    for i in range(16):
        matrix.SetElement(i % 4, i // 4, columns[i])
    return matrix


def actor_of(vtk, mesh):
    points, cells = vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetDataTypeToFloat()
    for i in range(0, len(mesh.positions), 3):
        points.InsertNextPoint(mesh.positions[i:i + 3])
    for t in range(0, len(mesh.triangles), 3):
        cells.InsertNextCell(3, mesh.triangles[t:t + 3])
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetVBOShiftScaleMethod(0)  # positions without shift and scale
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.SetUserMatrix(matrix_of(vtk, mesh.model))
    actor.GetProperty().LightingOff()
    color = mesh.flat()
    if color:
        actor.GetProperty().SetColor(*color[:3])
        actor.GetProperty().SetOpacity(color[3])
    else:
        data.GetPointData().SetScalars(scalars_of(vtk, mesh))
        mapper.SetColorModeToDirectScalars()
    (actor.ForceOpaqueOn if mesh.opaque else actor.ForceTranslucentOn)()
    return actor


def scalars_of(vtk, mesh):
    """Colours of vertices are bytes in VTK (vtkMapper::MapScalars), so that they are rounded here."""
    scalars = vtk.vtkUnsignedCharArray()
    scalars.SetNumberOfComponents(4)
    for i in range(0, len(mesh.colors), 4):
        scalars.InsertNextTuple([round(255 * c) for c in mesh.colors[i:i + 4]])
    return scalars


def camera_of(vtk, scene):
    """The view's matrix is the model transform of a camera at the origin that looks along -z."""
    camera = vtk.vtkCamera()
    camera.SetPosition(0, 0, 0)
    camera.SetFocalPoint(0, 0, -1)
    camera.SetViewUp(0, 1, 0)
    camera.SetModelTransformMatrix(matrix_of(vtk, scene.view))
    camera.UseExplicitProjectionTransformMatrixOn()
    camera.SetExplicitProjectionTransformMatrix(matrix_of(vtk, scene.projection))
    return camera


def matrices(look, width, height):
    """The matrices of VTK's own camera, as a camera file of Strata: {"view": ..., "projection": ...}."""
    import vtkmodules.all as vtk
    camera = vtk.vtkCamera()
    camera.SetPosition(look["eye"])
    camera.SetFocalPoint(look["center"])
    camera.SetViewUp(look["up"])
    camera.SetViewAngle(look["fovy_degrees"])
    camera.SetClippingRange(look["near"], look["far"])
    columns = lambda matrix: [matrix.GetElement(i % 4, i // 4) for i in range(16)]
    return {"view": columns(camera.GetModelViewTransformMatrix()), "projection": columns(camera.GetProjectionTransformMatrix(width / height, -1, 1))}


def use_old_peeling(vtk, renderer, peels):
    """The sequence of passes that VTK's own tests use with vtkDepthPeelingPass (TestDepthPeelingPass.cxx)."""
    sequence, passes = vtk.vtkSequencePass(), vtk.vtkRenderPassCollection()
    peeling, opaque, lights = vtk.vtkDepthPeelingPass(), vtk.vtkOpaquePass(), vtk.vtkLightsPass()
    peeling.SetMaximumNumberOfPeels(peels)
    peeling.SetOcclusionRatio(0)
    peeling.SetTranslucentPass(vtk.vtkTranslucentPass())
    for one in (lights, opaque, peeling):
        passes.AddItem(one)
    sequence.SetPasses(passes)
    camera_pass = vtk.vtkCameraPass()
    camera_pass.SetDelegatePass(sequence)
    renderer.SetPass(camera_pass)


def draw(scene, way, peels=None):
    """The picture as rows of bytes, R G B A, the top row first."""
    import vtkmodules.all as vtk
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(*scene.background)
    renderer.SetActiveCamera(camera_of(vtk, scene))
    for mesh in scene.runs():
        renderer.AddActor(actor_of(vtk, mesh))
    renderer.RemoveCuller(renderer.GetCullers().GetLastItem())  # it would cull actors that it considers small or outside, and sort
    if way == "dual":
        renderer.UseDepthPeelingOn()
        renderer.SetMaximumNumberOfPeels(PEELS if peels is None else peels)
        renderer.SetOcclusionRatio(0)
    elif way == "peeling":
        use_old_peeling(vtk, renderer, PEELS if peels is None else peels)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(scene.width, scene.height)
    window.AddRenderer(renderer)
    window.Render()
    pixels = vtk.vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, scene.width - 1, scene.height - 1, 0, pixels)
    data = bytes(memoryview(pixels))
    rows = [data[4 * scene.width * y:4 * scene.width * (y + 1)] for y in range(scene.height)]
    return b"".join(reversed(rows))
