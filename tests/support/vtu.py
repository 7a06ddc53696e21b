"""Reads what was drawn, with nothing but the XML and zlib of Python's library."""

import base64
import struct
import xml.etree.ElementTree
import zlib

import runner

CODES = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}


def decode(text, code):
    """The content of an array: in base64 a header, which has the number of blocks, their size, that of the last one if it is
    shorter, and their packed sizes; then the blocks."""
    count, size, rest = struct.unpack("<3Q", base64.b64decode(text[:32]))
    length = (8 * (3 + count) + 2) // 3 * 4
    packed_sizes = struct.unpack(f"<{3 + count}Q", base64.b64decode(text[:length]))[3:]
    packed, data = base64.b64decode(text[length:]), []
    runner.check(len(packed) == sum(packed_sizes), "the sizes of the blocks are not those of the header")
    for block, packed_size in enumerate(packed_sizes):
        data.append(zlib.decompress(packed[:packed_size]))
        packed = packed[packed_size:]
        whole = block + 1 < count or rest == 0
        runner.check(len(data[-1]) == (size if whole else rest), "a block of another size than the header says")
    return [value for (value,) in struct.iter_unpack("<" + code, b"".join(data))]


class Frame:
    """A VTU file: points, cells, and fields by their names, each a list of numbers or, of vectors, of lists."""

    def __init__(self, file):
        root = xml.etree.ElementTree.parse(file).getroot()
        runner.check(root.get("header_type") == "UInt64" and root.get("compressor") == "vtkZLibDataCompressor", "another format")
        runner.check(root.get("byte_order") == "LittleEndian", "another order of bytes")
        piece = root.find("UnstructuredGrid/Piece")
        self.arrays = {place: {entry.get("Name"): self.values(entry) for entry in piece.findall(f"{place}/DataArray")}
                       for place in ("Points", "Cells", "PointData", "CellData")}
        self.points = self.arrays["Points"]["Points"]
        self.types = self.arrays["Cells"]["types"]
        ends = self.arrays["Cells"]["offsets"]
        self.cells = [self.arrays["Cells"]["connectivity"][begin:end] for begin, end in zip([0] + ends, ends)]
        self.of_points, self.of_cells = self.arrays["PointData"], self.arrays["CellData"]
        counts = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
        runner.check(counts == (len(self.points), len(self.cells)) and len(self.types) == counts[1], f"not the {counts} of the file")
        for place, count in zip(("PointData", "CellData"), counts):
            for name, values in self.arrays[place].items():
                runner.check(len(values) == count, f"{len(values)} values of {name} instead of {count}")
        self.instant = {entry.get("Name"): float(entry.text) for entry in root.findall("UnstructuredGrid/FieldData/DataArray")}

    @staticmethod
    def values(entry):
        numbers = decode(entry.text.strip(), CODES[entry.get("type")])
        n = int(entry.get("NumberOfComponents", 1))
        return numbers if n == 1 else [numbers[i:i + n] for i in range(0, len(numbers), n)]

    def corners(self):
        """The points of each cell."""
        return [[self.points[point] for point in cell] for cell in self.cells]
