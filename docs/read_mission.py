#!/usr/bin/env python3
"""Reads a Foresight mission with nothing but Python: read_mission.py FILE prints each scan's ranges (docs/formats.md)."""
import sqlite3
import struct
import sys
import zlib


def channels(beams, has_intensity, data):
    """Ranges in millimetres (below 23: a status code) and intensities of one lidar line; codec 1."""
    planes, values = zlib.decompress(data), []
    for start in range(0, len(planes), 2 * beams):
        low, high = planes[start:start + beams], planes[start + beams:start + 2 * beams]
        last, channel = 0, []
        for code in (l | h << 8 for l, h in zip(low, high)):
            last = (last + (code >> 1 ^ -(code & 1))) & 0xFFFF
            channel.append(last)
        values.append(channel)
    return values if has_intensity else values + [[]]


mission = sqlite3.connect(f"file:{sys.argv[1]}?mode=ro", uri=True)
for scan, uuid, state in mission.execute("SELECT id, uuid, state FROM scan ORDER BY id"):
    print(f"scan {scan} {uuid} {state}")
    for (batch,) in mission.execute("SELECT data FROM motor WHERE scan_id = ? ORDER BY batch", [scan]):
        print("motor", *struct.unpack(f"<{len(batch) // 8}d", batch)[:2])  # seconds, radians; the first of each batch
    rows = "SELECT seq, time_s, beams, has_intensity, data FROM line WHERE scan_id = ? ORDER BY seq"
    for seq, time_s, beams, has_intensity, data in mission.execute(rows, [scan]):
        ranges, intensities = channels(beams, has_intensity, data)
        print("line", seq, time_s, sum(ranges), sum(intensities))
    if mission.execute("SELECT 1 FROM sqlite_schema WHERE name = 'given_line'").fetchone():  # an imported scan, from format 3 on
        for line, beams, data in mission.execute("SELECT line, beams, data FROM given_line WHERE scan_id = ? ORDER BY line", [scan]):
            floats = struct.unpack(f"<{3 + 3 * beams}f", zlib.decompress(data)[:12 + 12 * beams])  # origin, then all x, all y, all z
            print("given", line, *floats[:3], sum(x == x for x in floats[3:3 + beams]))  # how many returns
