"""VTK as the judge of our files: it reads what fascicle writes, and fascicle reads what it writes.

Run with the Python that Debian's python3-vtk9 is for (/usr/bin/python3); ends with 77, skipped, where VTK is not there.
"""
import os
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "app"))
try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    import numpy
except ImportError as problem:
    print(f"fascicle-skip: VTK's Python module is not there ({problem}); apt-get install python3-vtk9 python3-numpy")
    sys.exit(77)

import small_scene
from program import ProgramTest

READERS = {".vtp": vtk.vtkXMLPolyDataReader, ".vtk": vtk.vtkPolyDataReader, ".ply": vtk.vtkPLYReader,
           ".stl": vtk.vtkSTLReader, ".obj": vtk.vtkOBJReader}


class Complaints:
    """Collects what VTK says while it works; it prints errors and goes on."""

    def __init__(self):
        self.said = []
        self.old = None

    def __enter__(self):
        window = vtk.vtkStringOutputWindow()
        self.old = vtk.vtkOutputWindow.GetInstance()
        vtk.vtkOutputWindow.SetInstance(window)
        self.window = window
        return self

    def __exit__(self, *_):
        vtk.vtkOutputWindow.SetInstance(self.old)
        self.said = self.window.GetOutput()


def vtk_read(path):
    reader = READERS[path.suffix]()
    reader.SetFileName(str(path))
    if path.suffix == ".vtk":
        reader.ReadAllFieldsOn()
        reader.ReadAllScalarsOn()
        reader.ReadAllVectorsOn()
    if path.suffix == ".stl":
        reader.MergingOn()
    with Complaints() as complaints:
        reader.Update()
    assert not complaints.said, f"{path}: VTK says {complaints.said}"
    return reader.GetOutput()


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float) if data.GetNumberOfPoints() else numpy.zeros((0, 3))


def cells_of(cells):
    out, ids = [], vtk.vtkIdList()
    cells.InitTraversal()
    while cells.GetNextCell(ids):
        out.append(tuple(ids.GetId(i) for i in range(ids.GetNumberOfIds())))
    return out


def arrays_of(attributes):
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i)).astype(float)
            for i in range(attributes.GetNumberOfArrays()) if attributes.GetArray(i) is not None}


def fans(polygons):
    return [(p[0], p[i - 1], p[i]) for p in polygons for i in range(2, len(p))]


def surface(points_type=vtk.VTK_DOUBLE):
    """Triangles and quadrilaterals, with arrays of several types, of points that no float holds."""
    source = vtk.vtkSphereSource()
    source.SetThetaResolution(9)
    source.SetPhiResolution(7)
    source.LatLongTessellationOn()  # quadrilaterals
    source.Update()
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetDataType(points_type)
    for i in range(source.GetOutput().GetNumberOfPoints()):
        x, y, z = source.GetOutput().GetPoint(i)
        points.InsertNextPoint(100 * x + 1 / 3, 100 * y - 1e-7, 100 * z + 1234.5)
    data.SetPoints(points)
    data.SetPolys(source.GetOutput().GetPolys())
    count = points.GetNumberOfPoints()
    for name, kind, components in (("depth", vtk.vtkDoubleArray, 1), ("tangent", vtk.vtkFloatArray, 3),
                                   ("attachment", vtk.vtkUnsignedCharArray, 1), ("label", vtk.vtkIntArray, 1),
                                   ("id", vtk.vtkIdTypeArray, 1), ("short", vtk.vtkShortArray, 2),
                                   ("long", vtk.vtkUnsignedLongLongArray, 1), ("zero", vtk.vtkDoubleArray, 1)):
        array = kind()
        array.SetName(name)
        array.SetNumberOfComponents(components)
        for i in range(count * components):
            array.InsertNextValue(0 if name == "zero" else i % 250 if name in ("attachment", "short") else
                                  i / 7 if name in ("depth", "tangent") else 3 * i)
        array.SetNumberOfTuples(count)
        data.GetPointData().AddArray(array)
    return data


class VtkJudges(ProgramTest):
    def normal_form(self, path):
        """What fascicle understands of a file: converted to VTP, ascii and exact, and read by VTK."""
        out = self.folder / (path.name + ".normal.vtp")
        self.check_done("convert", path, out)
        return vtk_read(out)

    def check_same(self, ours, theirs, name, arrays=True, exact=True):
        a, b = points_of(ours), points_of(theirs)
        self.assertEqual(a.shape, b.shape, name)
        if exact:
            self.assertTrue((a == b).all(), f"{name}: points differ by {abs(a - b).max()}")
        else:
            self.assertTrue((a.astype("float32") == b.astype("float32")).all(), name)
        self.assertEqual(fans(cells_of(ours.GetPolys())), fans(cells_of(theirs.GetPolys())), name)
        self.assertEqual(cells_of(ours.GetLines()), cells_of(theirs.GetLines()), name)
        if arrays:
            mine, other = arrays_of(ours.GetPointData()), arrays_of(theirs.GetPointData())
            self.assertEqual(set(mine), set(other), name)
            for key, values in other.items():
                if theirs.GetPointData().GetArray(key).GetDataType() == vtk.VTK_FLOAT:  # of ascii we keep all digits
                    mine[key], values = mine[key].astype("float32"), values.astype("float32")
                self.assertTrue((mine[key] == values).all(), f"{name}: array {key}")

    # --- fascicle reads what VTK writes -------------------------------------------------------------------

    def test_vtp_of_every_mode(self):
        data = surface()
        done = 0
        for mode in ("ascii", "binary", "appended"):
            for encoded in ((False, True) if mode == "appended" else (False,)):
                for compressor in (("NONE",) if mode == "ascii" else ("NONE", "ZLIB")):
                    for header in (32, 64):
                        for order in ("LittleEndian", "BigEndian"):
                            writer = vtk.vtkXMLPolyDataWriter()
                            writer.SetInputData(data)
                            getattr(writer, "SetDataModeTo" + mode.capitalize())()
                            writer.SetEncodeAppendedData(encoded)
                            writer.SetCompressorType(getattr(vtk.vtkXMLWriter, compressor))
                            writer.SetHeaderType(header)
                            writer.SetBlockSize(4096)  # several blocks
                            getattr(writer, "SetByteOrderTo" + order)()
                            name = f"{mode}_{encoded}_{compressor}_{header}_{order}.vtp"
                            writer.SetFileName(str(self.folder / name))
                            self.assertEqual(writer.Write(), 1)
                            # In ascii VTK writes 11 digits of doubles: what it reads of its own file is compared.
                            self.check_same(self.normal_form(self.folder / name),
                                            vtk_read(self.folder / name) if mode == "ascii" else data, name)
                            done += 1
        self.assertEqual(done, 28)

    def test_lz4_and_lzma_are_refused_with_a_way_out(self):
        for kind, name in ((vtk.vtkXMLWriter.LZ4, "LZ4"), (vtk.vtkXMLWriter.LZMA, "LZMA")):
            writer = vtk.vtkXMLPolyDataWriter()
            writer.SetInputData(surface())
            writer.SetCompressorType(kind)
            writer.SetFileName(str(self.folder / f"{name}.vtp"))
            self.assertEqual(writer.Write(), 1)
            self.check_error(1, [f"{name}.vtp", f"compressed with {name}", "zlib or none"], "info", f"{name}.vtp")

    def test_legacy_of_both_versions_and_encodings(self):
        for points_type in (vtk.VTK_FLOAT, vtk.VTK_DOUBLE):
            data = surface(points_type)
            data.GetPointData().SetScalars(data.GetPointData().GetArray("label"))
            data.GetPointData().SetVectors(data.GetPointData().GetArray("tangent"))
            cell = vtk.vtkFloatArray()
            cell.SetName("of_cells")
            for i in range(data.GetNumberOfCells()):
                cell.InsertNextValue(i)
            data.GetCellData().SetScalars(cell)
            for version in (42, 51):
                for binary in (False, True):
                    writer = vtk.vtkPolyDataWriter()
                    writer.SetInputData(data)
                    writer.SetFileVersion(version)
                    writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
                    name = f"{points_type}_{version}_{binary}.vtk"
                    writer.SetFileName(str(self.folder / name))
                    self.assertEqual(writer.Write(), 1)
                    with open(self.folder / name, "rb") as file:
                        self.assertIn(b"Version 5.1" if version == 51 else b"Version 4.2", file.readline())
                    # In ascii we keep the digits of the file, VTK rounds them to the float that is announced.
                    self.check_same(self.normal_form(self.folder / name), vtk_read(self.folder / name), name,
                                    exact=binary or points_type == vtk.VTK_DOUBLE)

    def test_lines_with_arrays(self):
        points, lines, ids = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkIntArray()
        points.SetDataTypeToDouble()
        ids.SetName("fibre_id")
        for line in range(5):
            lines.InsertNextCell(4)
            ids.InsertNextValue(10 * line)
            for i in range(4):
                lines.InsertCellPoint(points.InsertNextPoint(line / 3, i / 7, i * line))
        data = vtk.vtkPolyData()
        data.SetPoints(points)
        data.SetLines(lines)
        data.GetCellData().AddArray(ids)
        for suffix, writer in ((".vtp", vtk.vtkXMLPolyDataWriter()), (".vtk", vtk.vtkPolyDataWriter())):
            writer.SetInputData(data)
            if suffix == ".vtk":
                writer.SetFileTypeToBinary()
            path = self.folder / ("lines" + suffix)
            writer.SetFileName(str(path))
            writer.Write()
            for out in (self.normal_form(path), self.converted(path, ".vtk")):
                self.check_same(out, data, path.name)
                self.assertEqual(list(arrays_of(out.GetCellData())["fibre_id"]), [0, 10, 20, 30, 40])

    def converted(self, path, suffix):
        out = self.folder / (path.name + ".out" + suffix)
        self.check_done("convert", path, out)
        return vtk_read(out)

    def test_ply(self):
        data = surface(vtk.VTK_FLOAT)
        colours = vtk.vtkUnsignedCharArray()
        colours.SetName("RGB")
        colours.SetNumberOfComponents(3)
        for i in range(3 * data.GetNumberOfPoints()):
            colours.InsertNextValue(7 * i % 256)
        data.GetPointData().AddArray(colours)
        for kind in ("ascii", "little", "big"):
            writer = vtk.vtkPLYWriter()
            writer.SetInputData(data)
            writer.SetArrayName("RGB")
            writer.SetFileTypeToASCII() if kind == "ascii" else writer.SetFileTypeToBinary()
            writer.SetDataByteOrderToBigEndian() if kind == "big" else writer.SetDataByteOrderToLittleEndian()
            path = self.folder / f"{kind}.ply"
            writer.SetFileName(str(path))
            self.assertEqual(writer.Write(), 1)
            theirs, ours = vtk_read(path), self.normal_form(path)
            self.check_same(ours, theirs, kind, arrays=False, exact=kind != "ascii")
            self.assertTrue((arrays_of(ours.GetPointData())["RGB"] == arrays_of(theirs.GetPointData())["RGB"]).all())

    def test_stl(self):
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputData(surface(vtk.VTK_FLOAT))
        triangles.Update()
        for binary in (False, True):
            writer = vtk.vtkSTLWriter()
            writer.SetInputData(triangles.GetOutput())
            writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
            path = self.folder / f"{binary}.stl"
            writer.SetFileName(str(path))
            self.assertEqual(writer.Write(), 1)
            theirs, ours = vtk_read(path), self.normal_form(path)
            # Merged by VTK in an order of its own: the corners of the triangles are compared.
            self.assertEqual(ours.GetNumberOfPoints(), theirs.GetNumberOfPoints())
            corners = [points_of(d)[numpy.array(cells_of(d.GetPolys())).ravel()].astype("float32") for d in (ours, theirs)]
            self.assertEqual(corners[0].shape, corners[1].shape)
            self.assertTrue((corners[0] == corners[1]).all())

    # --- VTK reads what fascicle writes -------------------------------------------------------------------

    def test_converted_meshes(self):
        small_scene.write_box(self.folder / "box.obj", [0.1, 0.2, 0.3], [20, 30, 50.7], (2, 3, 4))
        source = self.folder / "source.vtp"
        writer = vtk.vtkXMLPolyDataWriter()
        data = surface()
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputData(data)
        triangles.Update()
        writer.SetInputData(triangles.GetOutput())
        writer.SetFileName(str(source))
        writer.Write()
        for start in (source, self.folder / "box.obj"):
            truth = self.normal_form(start)
            self.assertGreater(truth.GetNumberOfPoints(), 40)
            for suffix in READERS:
                result = self.converted(start, suffix)
                name = start.name + suffix
                if suffix == ".stl":
                    self.assertEqual(result.GetNumberOfCells(), truth.GetNumberOfCells(), name)
                    self.assertEqual(result.GetNumberOfPoints(), truth.GetNumberOfPoints(), name)
                    self.assertAlmostEqual(volume(result) / volume(truth), 1, places=6)
                else:
                    # VTK's readers of OBJ and PLY keep floats.
                    self.check_same(result, truth, name, arrays=suffix in (".vtp", ".vtk"),
                                    exact=suffix in (".vtp", ".vtk"))

    def test_simulated_frames_and_their_series(self):
        source, _ = small_scene.write_scene(self.folder)
        out = self.folder / "run"
        self.check_done("simulate", *source, "--export", "vtp", "--every", "2", "--out", out)
        import xml.etree.ElementTree as tree
        series = tree.parse(out / "strap.pvd").getroot()
        self.assertEqual(series.attrib["type"], "Collection")
        steps = series.find("Collection").findall("DataSet")
        self.assertGreater(len(steps), 2)
        rest = vtk_read(out / steps[0].attrib["file"])
        table = (out / "metrics.csv").read_text().splitlines()
        columns = table[0].split(",")
        rows = {int(row.split(",")[0]): row.split(",") for row in table[1:]}
        for step in steps:
            frame = vtk_read(out / step.attrib["file"])
            self.assertEqual(cells_of(frame.GetPolys()), cells_of(rest.GetPolys()))
            self.assertEqual(frame.GetNumberOfPoints(), rest.GetNumberOfPoints())
            arrays = arrays_of(frame.GetPointData())
            for name in ("attachment", "attached_to", "depth", "edge_extension"):
                self.assertEqual(len(arrays[name]), frame.GetNumberOfPoints())
            # What VTK measures of the file is what the table of the run says.
            number = int(Path(step.attrib["file"]).suffixes[-2][1:])
            said = float(rows[number][columns.index("volume_ratio")])
            self.assertAlmostEqual(volume(frame) / volume(rest), said, places=6)
        self.check_done("info", out / "strap.pvd")


def volume(data):
    mass = vtk.vtkMassProperties()
    mass.SetInputData(data)
    mass.Update()
    return mass.GetVolume()


    def test_unit_and_frame_in_field_data(self):
        data, space = surface(), vtk.vtkStringArray()
        space.SetName("SPACE")  # as 3D Slicer says it
        space.InsertNextValue("RAS")
        data.GetFieldData().AddArray(space)
        for mode in (vtk.vtkXMLWriter.Ascii, vtk.vtkXMLWriter.Binary, vtk.vtkXMLWriter.Appended):
            for packed in (False, True):
                for encoded in (False, True):
                    writer = vtk.vtkXMLPolyDataWriter()
                    writer.SetFileName(str(self.folder / "slicer.vtp"))
                    writer.SetInputData(data)
                    writer.SetDataMode(mode)
                    writer.SetEncodeAppendedData(encoded)
                    if not packed:
                        writer.SetCompressorTypeToNone()
                    writer.Write()
                    self.assertIn("file's frame  RAS", self.check_done("info", "slicer.vtp"), (mode, packed, encoded))
        for binary in (False, True):
            writer = vtk.vtkPolyDataWriter()
            writer.SetFileName(str(self.folder / "slicer.vtk"))
            writer.SetInputData(data)
            writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
            writer.Write()
            self.assertIn("file's frame  RAS", self.check_done("info", "slicer.vtk"), binary)
        self.check_done("convert", "slicer.vtp", "ours.vtp", "--units", "m", "--axes", "ras_to_lps")
        fields = vtk_read(self.folder / "ours.vtp").GetFieldData()
        self.assertEqual(fields.GetAbstractArray("SPACE").GetValue(0), "LPS")
        self.assertEqual(fields.GetArray("MILLIMETRES_PER_UNIT").GetValue(0), 1000)

if __name__ == "__main__":
    unittest.main()
