"""VTK's XML files in every way in which programs write numbers, and what is refused because it is not whole."""

import base64
import pathlib
import struct
import sys
import tempfile
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import runner

folder = pathlib.Path(tempfile.mkdtemp(prefix="supple-"))
scene = folder / "scene.prm"
scene.write_text("# a mesh file\nsubsection Mesh\n  set Shape = file\nend\n")

# Two tetrahedra with the ids 1 and 2, and two triangles of their surface with the ids 10 and 20.
POINTS = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]
ARRAYS = {"Points": ("Float64", POINTS), "connectivity": ("Int64", [0, 1, 2, 3, 1, 2, 3, 4, 0, 1, 2, 0, 1, 3]), "offsets": ("Int64", [4, 8, 11, 14]),
          "types": ("UInt8", [10, 10, 5, 5]), "MaterialIds": ("Int32", [1, 2, 10, 20])}
LETTERS = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt8": "B"}
BODY = ["2 tetrahedra, 5 vertices", "0.5 m^3", "materials   1 (1), 2 (1)", "boundaries  0 (4), 10 (1), 20 (1)"]


class Writer:
    """A file whose arrays are in text, binary or appended; packed or not; with headers of 32 or 64 bits."""

    def __init__(self, form="ascii", packed=False, wide=False, big=False, encoding="base64", split=False):
        self.form, self.packed, self.encoding, self.split = form, packed, encoding, split
        self.order, self.header = (">" if big else "<"), ("Q" if wide else "I")
        self.attributes = f'byte_order="{"BigEndian" if big else "LittleEndian"}" header_type="{"UInt64" if wide else "UInt32"}"'
        self.attributes += ' compressor="vtkZLibDataCompressor"' if packed else ""
        self.appended = b""

    def encoded(self, kind, values):
        data = struct.pack(f"{self.order}{len(values)}{LETTERS[kind]}", *values)
        if self.packed:
            blocks = [data[i:i + 32] for i in range(0, len(data), 32)]
            packed = [zlib.compress(block) for block in blocks]
            numbers = [len(blocks), 32, len(data) % 32, *map(len, packed)]
            parts = [struct.pack(f"{self.order}{len(numbers)}{self.header}", *numbers), b"".join(packed)]
        else:
            parts = [struct.pack(self.order + self.header, len(data)), data]
        if self.form == "appended" and self.encoding == "raw":
            return b"".join(parts)
        return b"".join(map(base64.b64encode, parts)) if self.packed or self.split else base64.b64encode(b"".join(parts))

    def array(self, name, kind, values):
        head = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{3 if name == "Points" else 1}" format="{self.form}"'
        if self.form == "ascii":
            return f"{head}>\n{' '.join(map(str, values))}\n</DataArray>\n"
        if self.form == "binary":
            return f"{head}>\n  {self.encoded(kind, values).decode()}\n</DataArray>\n"
        offset, self.appended = len(self.appended), self.appended + self.encoded(kind, values)
        return f'{head} offset="{offset}"/>\n'

    def piece(self, arrays):
        one = {name: self.array(name, *arrays[name]) for name in arrays}
        cells = "".join(one[name] for name in ("connectivity", "offsets", "types"))
        fields = "".join(text for name, text in one.items() if name not in ("Points", "connectivity", "offsets", "types"))
        return (f'<Piece NumberOfPoints="{len(arrays["Points"][1]) // 3}" NumberOfCells="{len(arrays["types"][1])}">\n'
                f"<CellData>\n{fields}</CellData>\n<Points>{one['Points']}</Points>\n<Cells>\n{cells}</Cells>\n</Piece>\n")

    def file(self, *pieces):
        text = f'<?xml version="1.0"?>\n<!-- a mesh -->\n<VTKFile type="UnstructuredGrid" version="1.0" {self.attributes}>\n<UnstructuredGrid>\n'
        data = (text + "".join(map(self.piece, pieces)) + "</UnstructuredGrid>\n").encode()
        if self.form == "appended":
            data += f'<AppendedData encoding="{self.encoding}">\n_'.encode() + self.appended + b"\n</AppendedData>\n"
        return data + b"</VTKFile>\n"


def check(data):
    (folder / "body.vtu").write_bytes(data)
    return runner.run("--check", scene, "--set", "Mesh/File=body.vtu")


def accepted(data, words, warnings=0):
    output = runner.accepted(check(data), words, "body.vtu")
    runner.check(output.count("warning") == warnings, output)


def refused(data, *words):
    runner.refused(check(data), words, "body.vtu")


accepted(Writer().file(ARRAYS), BODY)
for packed in (False, True):
    for wide, big in ((False, False), (True, False), (False, True)):
        accepted(Writer("binary", packed, wide, big).file(ARRAYS), BODY)
        accepted(Writer("appended", packed, wide, big).file(ARRAYS), BODY)
        accepted(Writer("appended", packed, wide, big, "raw").file(ARRAYS), BODY)
accepted(Writer("binary", split=True).file(ARRAYS), BODY)
accepted(Writer().file({**ARRAYS, "Points": ("Float32", POINTS), "connectivity": ("Int32", ARRAYS["connectivity"][1])}), BODY)
accepted(Writer().file(ARRAYS).replace(b"\n", b"\r\n"), BODY)

# Several pieces count their points and cells anew; ghost cells are those of another piece.
one = {"Points": ("Float64", POINTS[:12]), "connectivity": ("Int64", [0, 1, 2, 3, 0, 1, 2]), "offsets": ("Int64", [4, 7]), "types": ("UInt8", [10, 5]),
       "MaterialIds": ("Int32", [1, 10])}
two = {**one, "Points": ("Float64", POINTS[3:]), "MaterialIds": ("Int32", [2, 20])}
accepted(Writer("appended").file(one, two), ["2 tetrahedra, 8 vertices", "materials   1 (1), 2 (1)", "10 (1), 20 (1)"], warnings=2)
refused(Writer().file(one, {name: two[name] for name in ("Points", "connectivity", "offsets", "types")}), "MaterialIds", "values for 4 cells")
accepted(Writer().file({**ARRAYS, "vtkGhostType": ("UInt8", [0, 1, 0, 0])}), ["1 tetrahedra", "1 ghost cell(s)"], warnings=2)

good = Writer().file(ARRAYS)
refused(good.replace(b"UnstructuredGrid", b"PolyData"), "PolyData", "UnstructuredGrid")
refused(Writer().file({**ARRAYS, "types": ("UInt8", [24, 10, 5, 5])}), "the cell 0 has not 10 vertices")
refused(Writer().file({**ARRAYS, "Points": ("Float64", POINTS[:12])}), "the vertex 4, but there are only 4")
refused(good.replace(b'NumberOfPoints="5"', b'NumberOfPoints="6"'), "has 15 values; there should be 18")
refused(good.replace(b"4 8 11 14", b"4 8 11 15"), "offsets ends with 15")
refused(good.replace(b"4 8 11 14", b"4 x 11 14"), "a number is 'x'")
refused(good.replace(b"</Cells>", b"</Cell>"), "mismatched tag", "line ")
refused(good[:len(good) // 2], "line ")
refused(good.replace(b'Name="offsets"', b'Name="other"'), "the array offsets is missing")
refused(Writer("binary", True).file(ARRAYS).replace(b"vtkZLib", b"vtkLZ4"), "vtkLZ4DataCompressor", "Compressor Type ZLib")
raw = Writer("appended", encoding="raw").file(ARRAYS)
refused(raw[:raw.index(b"\n_") + 100], "ends before all its numbers are there")
