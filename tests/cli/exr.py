"""OpenEXR files as tests read them, without the library that writes them."""

import struct
import zlib


def read_exr(data):
    """Header attributes and float channels of a scan-line file in ZIP blocks, by the published file layout."""
    assert data[:8] == struct.pack("<ii", 20000630, 2)
    at, attributes = 8, {}

    def text():
        nonlocal at
        end = data.index(b"\0", at)
        at, word = end + 1, data[at:end].decode()
        return word

    while data[at]:
        name, kind = text(), text()
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = (kind, data[at + 4:at + 4 + size])
        at += 4 + size
    at += 1
    channels, raw = [], attributes["channels"][1]
    while raw[0]:
        name, raw = raw.split(b"\0", 1)
        channels.append((name.decode(), struct.unpack_from("<i", raw)[0]))
        raw = raw[16:]
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"][1])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    assert attributes["compression"][1] == b"\3"  # ZIP: 16 rows
    planes = {name: [] for name, _ in channels}
    for offset in struct.unpack_from(f"<{(height + 15) // 16}Q", data, at):
        row, size = struct.unpack_from("<ii", data, offset)
        block = data[offset + 8:offset + 8 + size]
        rows = min(16, height - (row - y0))
        if size < rows * width * 4 * len(channels):
            block = bytearray(zlib.decompress(block))
            for i in range(1, len(block)):  # differences of bytes
                block[i] = (block[i] + block[i - 1] - 128) & 255
            half = (len(block) + 1) // 2  # even and odd bytes apart
            joined = bytearray(len(block))
            joined[0::2], joined[1::2] = block[:half], block[half:]
            block = bytes(joined)
        at_value = 0
        for _ in range(rows):
            for name, kind in channels:
                planes[name] += struct.unpack_from(f"<{width}{'I' if kind == 0 else 'f'}", block, at_value)
                at_value += 4 * width
    return attributes, planes
