"""Reads what was drawn."""

import base64
import re
import struct
import zlib

import runner


def field(file, name):
    """An array of a VTU file, of four-byte floats unless it is named types. Every cell has its own points, and their values."""
    begin = r"<Points>\s*<DataArray" if name == "Points" else f'Name="{name}"'
    text = re.search(rf"{begin}[^>]*>\s*(\S+)", file.read_text()).group(1)
    blocks, _, _, _ = struct.unpack("<4I", base64.b64decode(text[:24]))
    runner.check(blocks == 1, "more than one block")
    data = zlib.decompress(base64.b64decode(text[24:]))
    return list(data) if name == "types" else [value for (value,) in struct.iter_unpack("<f", data)]
